/// Modes and attachments of deformable bodies in the equations.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/initial_pose.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/element/linear_points.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::build {

namespace {

constexpr std::string_view mode_loads = "modes";

/// Place and rotation of an attachment relative to its body; both markers have the axes of the
/// world in the reference pose.
const joint::JointType attachment_type = {"attachment",
                                          {},
                                          {joint::slides(joint::X), joint::slides(joint::Y),
                                           joint::slides(joint::Z), joint::turns(joint::X),
                                           joint::turns(joint::Y), joint::turns(joint::Z)},
                                          false};

/// Motions of the modes of a body, in their order.
std::vector<int> amplitudes(const model::Scene& scene, const std::string& body, system::System& s) {
  std::vector<int> out;
  for (const std::size_t mode : model::modes_of(scene, body))
    out.push_back(body_motion(scene, model::part_of_mode(scene, mode).name, "surge", s));
  return out;
}

/// Map (6 + n, 3 (own + n)) from displacements of points to surge ... yaw and amplitudes: `own`
/// points on the body (its centre c, c + x, c + y and optionally c + z, at a lever of 1 m), and one
/// for each mode. Horizontal ones are along axes turned by the mean yaw; first order in the angles.
MatrixX from_points(Index own, Index n, double yaw) {
  MatrixX T = MatrixX::Zero(6 + n, 3 * (own + n));
  const double c = std::cos(yaw), d = std::sin(yaw);
  T.block<2, 2>(0, 0) << c, d, -d, c;
  T(2, 2) = 1.0;
  T(3, 8) = 1.0, T(3, 2) = -1.0; // roll: c + y rises
  T(4, 2) = 1.0, T(4, 5) = -1.0; // pitch: c + x sinks
  T.block<1, 2>(5, 3) << -d, c;  // yaw: c + x moves along y
  T.block<1, 2>(5, 0) << d, -c;
  for (Index k = 0; k < n; ++k)
    T(6 + k, 3 * (own + k)) = 1.0;
  return T;
}

/// Hydrostatics of the modes of a body (6 + n, 6 + n), without the block of the six.
MatrixX hydrostatics(const model::Scene& scene, const model::Body& body,
                     const std::vector<std::size_t>& modes) {
  const auto n = static_cast<Index>(modes.size());
  MatrixX out = MatrixX::Zero(6 + n, 6 + n);
  if (!body.hydro || !scene.database)
    return out;
  const hydro::DatabaseBody& entry = *hydro::find_body(*scene.database, *body.hydro);
  std::vector<Index> place = {0, 1, 2, 3, 4, 5};
  for (const std::size_t mode : modes)
    place.push_back(6 +
                    (std::find(entry.modes.begin(), entry.modes.end(), scene.modes[mode].label()) -
                     entry.modes.begin()));
  for (Index i = 0; i < 6 + n; ++i)
    for (Index j = 0; j < 6 + n; ++j)
      if (i >= 6 || j >= 6)
        out(i, j) = entry.mode_stiffness(place[static_cast<std::size_t>(i)],
                                         place[static_cast<std::size_t>(j)]);
  if (scene.hydro->axes_kind() == water::HydroAxes::yaw)
    for (const Index c : {0, 1, 5}) { // still water is the same at every place and yaw
      out.row(c).setZero();
      out.col(c).setZero();
    }
  return out;
}

/// Stiffness (3 (4 + n), 3 (4 + n)) of the weight on the modes, between the points of
/// `from_points`. Their heights give R^T e_z, so that the potential g e_z . R sum w_k q_k is a
/// quadratic form. It bends the body at any pose, and turns it by the shift of its centre of mass.
MatrixX weight_on_modes(const model::Scene& scene, const std::vector<std::size_t>& modes,
                        double gravity) {
  const Index size = 3 * (4 + std::ssize(modes));
  MatrixX out = MatrixX::Zero(size, size);
  for (Index k = 0; k < std::ssize(modes); ++k) {
    const Vector3 w =
        scene.modes[modes[static_cast<std::size_t>(k)]].participation.value_or(Vector3::Zero());
    const Index q = 3 * (4 + k);
    for (Index i = 0; i < 3; ++i) {
      out(q, 3 * (1 + i) + 2) = gravity * w[i];
      out(q, 2) -= gravity * w[i];
    }
    out.col(q) = out.row(q).transpose();
  }
  return out;
}

bool is_bent_by_weight(const model::Scene& scene, const std::vector<std::size_t>& modes,
                       double gravity) {
  return gravity != 0.0 && std::any_of(modes.begin(), modes.end(), [&](std::size_t k) {
           const std::optional<Vector3>& w = scene.modes[k].participation;
           return w && !w->isZero(0.0);
         });
}

double mean_yaw(const system::System& s, int body) {
  for (const system::HydroBody& hb : s.hydro.bodies)
    if (hb.body == body)
      return hb.yaw;
  return 0.0;
}

system::ElementList loads_of(const model::Scene& scene, const model::Body& body,
                             const std::vector<std::size_t>& modes, const system::System& s) {
  const auto n = static_cast<Index>(modes.size());
  MatrixX K = hydrostatics(scene, body, modes), C = MatrixX::Zero(6 + n, 6 + n);
  system::PortData port;
  port.component = mode_loads;
  const Vector3& centre = body.center_of_gravity;
  const bool weighs = is_bent_by_weight(scene, modes, s.gravity);
  std::vector<Vector3> arms = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  if (weighs)
    arms.emplace_back(0, 0, 1);
  const Index own = std::ssize(arms);
  for (const Vector3& arm : arms)
    port.points.push_back(make_marker(scene, body.name, centre + arm, Matrix3::Identity()));
  for (Index k = 0; k < n; ++k) {
    const std::size_t mode = modes[static_cast<std::size_t>(k)];
    K(6 + k, 6 + k) += scene.modes[mode].stiffness;
    C(6 + k, 6 + k) = scene.modes[mode].damping;
    const model::Body& part = model::part_of_mode(scene, mode);
    port.points.push_back(
        make_marker(scene, part.name, part.center_of_gravity, Matrix3::Identity()));
  }
  const double yaw = mean_yaw(s, port.points.front().body);
  const MatrixX T = from_points(own, n, yaw);
  VectorX reference(T.cols());
  const Matrix3 turn = rotation_about_axis<double>(2, yaw);
  for (Index i = 0; i < own + n; ++i) {
    const joint::Marker& point = port.points[static_cast<std::size_t>(i)];
    reference.segment<3>(3 * i) = s.bodies[static_cast<std::size_t>(point.body)].reference +
                                  (i < own ? Vector3(turn * point.point) : point.point);
  }
  MatrixX stiffness = T.transpose() * K * T;
  if (weighs) {
    stiffness += weight_on_modes(scene, modes, s.gravity);
    reference[11] = reference[2]; // height of c + z: as high as c, like the other two
  }
  system::ElementList list;
  list.laws = std::make_shared<const element::LinearPoints>(mode_loads, body.name, reference,
                                                            stiffness, T.transpose() * C * T);
  list.ports.push_back(std::move(port));
  return list;
}

} // namespace

void add_attachments(const model::Scene& scene, system::System& s) {
  for (const model::Attachment& place : scene.attachments) {
    system::JointData j;
    j.name = place.name;
    j.type = &attachment_type;
    j.A = make_marker(scene, place.body, place.point, Matrix3::Identity());
    j.B = make_marker(scene, place.name, place.point, Matrix3::Identity());
    j.hidden = true;
    const int first = add_joint(s, std::move(j)).first_motion;
    const std::vector<int> modes = amplitudes(scene, place.body, s);
    const std::array<bool, 6> free =
        model::free_coordinates(*model::find_named(scene.bodies, place.name));
    for (int c = 0; c < 6; ++c) {
      if (!free[static_cast<std::size_t>(c)])
        continue;
      system::CouplerData coupler;
      coupler.name = place.name + "." + std::string(model::coordinate_names[c]);
      coupler.hidden = true;
      coupler.terms = {{first + c, 1.0}};
      const std::vector<Vector3>& shape = c < 3 ? place.displacement : place.rotation;
      for (std::size_t k = 0; k < shape.size(); ++k)
        if (const double by_mode = shape[k][c % 3]; by_mode != 0.0)
          coupler.terms.push_back({modes[k], -by_mode});
      s.couplers.push_back(std::move(coupler));
    }
  }
}

void note_weights(const model::Scene& scene, system::System& s) {
  if (s.gravity == 0.0)
    return;
  for (const model::Mode& mode : scene.modes) {
    const model::Body& body = *model::find_named(scene.bodies, mode.body);
    const bool may = model::may_participate(scene, body, 0) ||
                     model::may_participate(scene, body, 1) ||
                     model::may_participate(scene, body, 2);
    if (may && !mode.participation)
      s.notes.push_back("the weight of body " + in_quotes(mode.body) + " does not load its mode " +
                        in_quotes(mode.name) +
                        ": give the participation of the mode; [0, 0, 0] if it takes no part");
  }
}

void set_mode_loads(const model::Scene& scene, system::System& s) {
  auto next = s.elements.begin();
  for (const model::Body& body : scene.bodies) {
    const std::vector<std::size_t> modes = model::modes_of(scene, body.name);
    if (modes.empty() || body.part)
      continue;
    system::ElementList list = loads_of(scene, body, modes, s);
    next = std::find_if(next, s.elements.end(), [&](const system::ElementList& old) {
      return old.laws->type == mode_loads;
    });
    if (next == s.elements.end()) {
      s.elements.push_back(std::move(list));
      next = s.elements.end();
    } else {
      *next++ = std::move(list);
    }
  }
}

} // namespace hydrodae::build
