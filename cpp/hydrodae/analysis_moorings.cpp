#include "hydrodae/analysis_moorings.h"

#include <Eigen/LU>

#include "hydrodae/system/elements.h"

namespace hydrodae {

namespace {

using system::System;

bool moors(const element::Elements& laws) {
  return laws.shape.port == element::Port::points ||
         laws.shape.port == element::Port::along_distance || laws.type == "mooring_matrix";
}

/// A law as it was evaluated and differentiated: load and its derivatives by x and v, its algebraic
/// unknowns taken out.
struct Slope {
  VectorX load;
  MatrixX by_x, by_v;
};

Slope slope(const element::Shape& shape, const double* out, const double* jacobian) {
  const Index w = shape.width, a = shape.n_algebraic;
  const Eigen::Map<const MatrixX> J(jacobian, shape.n_out(), shape.n_columns());
  Slope found{Eigen::Map<const VectorX>(out, w), J.topLeftCorner(w, w), J.block(0, w, w, w)};
  if (a > 0) {
    const MatrixX follow =
        J.bottomRightCorner(a, a).partialPivLu().solve(MatrixX(J.bottomLeftCorner(a, 2 * w)));
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

/// A load f along the distance l of two points, as forces on these:
///
///   force on B = f e,   d (force on B) / d B = f' e e^T + f / l (I - e e^T)
void put_apart(const Slope& at, Mooring& out) {
  const Vector3 d = out.places[1] - out.places[0];
  const Vector3 e = d.normalized();
  const Matrix3 along = e * e.transpose();
  const Matrix3 by_place =
      at.by_x(0) * along + at.load[0] / d.norm() * (Matrix3::Identity() - along);
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

void add_list(const System& s, const system::ElementList& list, system::Workspace<double>& ws,
              const VectorX& y, std::vector<Mooring>& out) {
  const element::Elements& laws = *list.laws;
  const element::Shape& shape = laws.shape;
  const auto n_in = static_cast<std::size_t>(shape.n_in()),
             n_out = static_cast<std::size_t>(shape.n_out());
  system::ElementScratch<double>& scratch = ws.elements[system::index_of(s, list)];
  system::gather<double>(s, list, ws, y.data(), scratch);
  const double* in = scratch.in.data();
  std::vector<double> J(laws.size() * n_out * n_in), values(laws.size() * laws.channels.size());
  laws.evaluate(0.0, in, list.signals.data(), scratch.out.data());
  laws.jacobian(0.0, in, list.signals.data(), J.data());
  laws.observe(0.0, in, list.signals.data(), scratch.out.data(), values.data());
  const auto n_channels = static_cast<Index>(laws.channels.size());
  for (std::size_t k = 0; k < laws.size(); ++k) {
    Mooring m;
    m.name = laws.names[k];
    m.type = laws.type;
    const system::PortData& port = list.ports[k];
    const Slope at = slope(shape, scratch.out.data() + k * n_out, J.data() + k * n_out * n_in);
    m.values =
        Eigen::Map<const VectorX>(values.data() + static_cast<Index>(k) * n_channels, n_channels);
    for (const element::Quantity& channel : laws.channels) {
      m.channels.emplace_back(channel.name);
      m.units.emplace_back(channel.unit);
    }
    if (shape.port == element::Port::along_distance) {
      const system::JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
      add_point(ws, j.A, m);
      add_point(ws, j.B, m);
      put_apart(at, m);
      m.channels.emplace_back("force");
      m.units.emplace_back("N");
      m.values.conservativeResize(n_channels + 1);
      m.values[n_channels] = at.load[0];
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

std::vector<Mooring> moorings(const System& s, system::Workspace<double>& ws, const VectorX& y) {
  std::vector<Mooring> out;
  for (const system::ElementList& list : s.elements)
    if (moors(*list.laws))
      add_list(s, list, ws, y, out);
  return out;
}

} // namespace hydrodae
