#include "hydrodae/statics/analysis_moorings.h"

#include "hydrodae/math/dense.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::statics {

namespace {

using system::Regime;

bool moors(const element::Elements& laws) {
  const bool apart =
      laws.shape.port == element::Port::points || laws.shape.port == element::Port::along_distance;
  return laws.moors || (apart && !laws.buoyant);
}

/// Value and derivatives of a law: load and its derivatives by x and v, with algebraic unknowns
/// eliminated.
struct Slope {
  VectorX load;
  MatrixX by_x, by_v;
};

Slope slope(const element::Shape& shape, const double* out, const double* jacobian) {
  const Index w = shape.width, a = shape.n_algebraic;
  const Eigen::Map<const MatrixX> J(jacobian, shape.n_out(), shape.n_columns());
  Slope found{Eigen::Map<const VectorX>(out, w), J.topLeftCorner(w, w), J.block(0, w, w, w)};
  if (a > 0) {
    const MatrixX follow = solve_square(J.bottomRightCorner(a, a), J.bottomLeftCorner(a, 2 * w));
    found.by_x -= J.topRightCorner(w, a) * follow.leftCols(w);
    found.by_v -= J.topRightCorner(w, a) * follow.rightCols(w);
  }
  return found;
}

void add_point(const system::Workspace<double>& ws, const joint::Marker& point, Mooring& out) {
  out.bodies.push_back(point.body);
  out.places.push_back(point.point);
  if (point.body >= 0) {
    const auto& b = ws.bodies[static_cast<std::size_t>(point.body)];
    out.places.back() = b.r + b.R * point.point;
  }
}

/// Load f along the distance l of two points, as forces on the points:
///
///   force on B = f e,   d (force on B) / d B = f' e e^T + f / l (I - e e^T)
void put_apart(const Slope& at, Mooring& out) {
  const Vector3 d = out.places[1] - out.places[0];
  const Vector3 e = d.normalized();
  const Matrix3 along = e * e.transpose();
  // limit at zero distance
  const double across = d.isZero(0.0) ? at.by_x(0) : at.load[0] / d.norm();
  const Matrix3 by_place = at.by_x(0) * along + across * (Matrix3::Identity() - along);
  const Matrix3 by_rate = at.by_v(0) * along;
  out.load.resize(6);
  out.load << -at.load[0] * e, at.load[0] * e;
  const auto spread = [](const Matrix3& k) {
    MatrixX both(6, 6);
    both << -k, k, k, -k;
    return both;
  };
  out.stiffness = spread(by_place);
  out.damping = spread(by_rate);
}

/// Slopes of each law of a list; laws with nodes are at rest at the present ends.
std::vector<Slope> slopes_at_rest(const system::ElementList& list, const double* signals,
                                  const double* in, const double* out) {
  const std::shared_ptr<const element::Elements> still = list.laws->statics();
  const element::Elements& laws = still ? *still : *list.laws;
  const element::Shape &given = list.laws->shape, &shape = laws.shape;
  const auto n_in = static_cast<std::size_t>(shape.n_in()),
             n_out = static_cast<std::size_t>(shape.n_out());
  std::vector<double> seen, loads;
  if (still) { // places and velocities of the ends only
    for (std::size_t k = 0; k < laws.size(); ++k, in += given.n_in())
      seen.insert(seen.end(), in, in + shape.n_in());
    loads.resize(laws.size() * n_out);
    laws.evaluate(0.0, seen.data(), signals, loads.data());
    in = seen.data();
    out = loads.data();
  }
  std::vector<double> J(laws.size() * n_out * n_in);
  laws.jacobian(0.0, in, signals, J.data());
  std::vector<Slope> found;
  for (std::size_t k = 0; k < laws.size(); ++k)
    found.push_back(slope(shape, out + k * n_out, J.data() + k * n_out * n_in));
  return found;
}

/// Adds the scalar channels of a law.
void add_channels(const element::Elements& laws, const double* values, Mooring& m) {
  for (const element::Quantity& channel : laws.channels) {
    if (channel.width == 1) {
      m.channels.emplace_back(channel.name);
      m.units.emplace_back(channel.unit);
      m.values.conservativeResize(m.values.size() + 1);
      m.values[m.values.size() - 1] = *values;
    }
    values += channel.width;
  }
}

void add_list(const Regime& s, const system::ElementList& list, system::Workspace<double>& ws,
              const VectorX& y, std::vector<Mooring>& out) {
  const element::Elements& laws = *list.laws;
  const element::Shape& shape = laws.shape;
  system::ElementScratch<double>& scratch = ws.elements[system::index_of(s, list)];
  system::gather<double>(s, list, ws, y.data(), scratch);
  const double* in = scratch.in.data();
  std::vector<double> values(laws.size() * laws.channel_size());
  laws.evaluate(0.0, in, s.held(list), scratch.out.data());
  laws.observe(0.0, in, s.held(list), scratch.out.data(), values.data());
  const std::vector<Slope> slopes = slopes_at_rest(list, s.held(list), in, scratch.out.data());
  for (std::size_t k = 0; k < laws.size(); ++k) {
    Mooring m;
    m.name = laws.names[k];
    m.type = laws.type;
    const system::PortData& port = list.ports[k];
    const Slope& at = slopes[k];
    add_channels(laws, values.data() + k * laws.channel_size(), m);
    if (shape.port == element::Port::along_distance) {
      const system::JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
      add_point(ws, j.A, m);
      add_point(ws, j.B, m);
      put_apart(at, m);
      m.channels.emplace_back("force");
      m.units.emplace_back("N");
      m.values.conservativeResize(m.values.size() + 1);
      m.values[m.values.size() - 1] = at.load[0];
    } else {
      for (const joint::Marker& point : port.points)
        add_point(ws, point, m);
      if (shape.port == element::Port::on_body) {
        m.bodies.push_back(port.body);
        m.places.push_back(ws.bodies[static_cast<std::size_t>(port.body)].r);
      }
      m.load = at.load;
      m.stiffness = -at.by_x;
      m.damping = -at.by_v;
    }
    out.push_back(std::move(m));
  }
}

} // namespace

std::vector<Mooring> moorings(const Regime& s, system::Workspace<double>& ws, const VectorX& y) {
  std::vector<Mooring> out;
  for (const system::ElementList& list : s.elements)
    if (moors(*list.laws))
      add_list(s, list, ws, y, out);
  return out;
}

} // namespace hydrodae::statics
