#include "hydrodae/accuracy/places.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/system/mechanisms.h"

namespace hydrodae::accuracy {

namespace {

constexpr Index n_pose = 12; ///< numbers of a pose: r and R

/// Angle of R_a^T R_b, from the sine of half of it, which is exact for small angles.
double turn(const double* a, const double* b) {
  using Map = Eigen::Map<const Matrix3>;
  const double half = (Map(a) - Map(b)).norm() / std::sqrt(8.0);
  return 2.0 * std::asin(std::min(half, 1.0));
}

} // namespace

Movers::Movers(const system::Regime& s)
    : s_(s.system), bodies_(system::Workspace<double>(s).bodies),
      n_groups_(static_cast<std::size_t>(s.n_error_groups())) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (const system::BodyData& b = s.bodies[i]; b.group >= 0) {
      all_.push_back({b.name, static_cast<std::size_t>(b.group), i, b.lever, n_places_, {}});
      n_places_ += n_pose;
    }
  for (const system::Block& block : s.blocks) {
    if (block.states < 0 || !block.moves)
      continue;
    Mover line{block.name.substr(block.name.rfind('/') + 1),
               static_cast<std::size_t>(block.group),
               0,
               0.0,
               n_places_,
               {}};
    system::for_each_point(s.states[static_cast<std::size_t>(block.states)],
                           [&](Index place, Index, double) { line.nodes.push_back(place - s.z0); });
    n_places_ += 3 * static_cast<Index>(line.nodes.size());
    all_.push_back(std::move(line));
  }
  for (std::size_t m = 0; m < s.motions.size(); ++m)
    if (s.motions[m].motion.is_angle())
      if (const system::BodyData* b =
              system::moving_body(s, system::joint_of(s, static_cast<int>(m)));
          b && b->group >= 0)
        turning_.push_back({m, static_cast<std::size_t>(b->group), b->lever});
}

void Movers::places(const VectorX& y, VectorX& out) {
  system::unpack<double>(s_, y.data(), y.data(), bodies_); // the accelerations are not used
  out.resize(n_places_);
  for (const Mover& m : all_) {
    if (m.nodes.empty()) {
      out.segment<3>(m.first) = bodies_[m.body].r;
      Eigen::Map<Matrix3>(out.data() + m.first + 3) = bodies_[m.body].R;
    }
    for (std::size_t k = 0; k < m.nodes.size(); ++k)
      out.segment<3>(m.first + 3 * static_cast<Index>(k)) = y.segment<3>(s_.z0 + m.nodes[k]);
  }
}

Apart Movers::apart(std::size_t mover, const VectorX& a, const VectorX& b) const {
  const Mover& m = all_[mover];
  const auto moved = [&](Index at) { return (a.segment<3>(at) - b.segment<3>(at)).norm(); };
  if (m.nodes.empty())
    return {moved(m.first), m.lever * turn(a.data() + m.first + 3, b.data() + m.first + 3)};
  Apart out;
  for (std::size_t k = 0; k < m.nodes.size(); ++k)
    out.moved = std::max(out.moved, moved(m.first + 3 * static_cast<Index>(k)));
  return out;
}

void Movers::widen(const std::vector<double>& turns, const std::vector<double>& start,
                   std::vector<Apart>& motion) const {
  for (const Turning& t : turning_)
    motion[t.group].widen({0.0, t.lever * std::abs(turns[t.motion] - start[t.motion])});
}

} // namespace hydrodae::accuracy
