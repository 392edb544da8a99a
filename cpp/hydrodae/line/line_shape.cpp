/// Initial shape in the search for the rest of a line.

#include <algorithm>
#include <cmath>

#include "hydrodae/line/line_statics.h"
#include "hydrodae/math/catenary.h"

namespace hydrodae::line {

namespace {

double net_weight(const LineModel& m, const LineNode& node) {
  return node.mass * m.gravity - (m.wet ? node.lift + node.body_lift : 0.0);
}

/// Height of a node that lies on the bed.
double resting_height(const LineModel& m, const Vector3& x, int node) {
  return m.bed_at<double>(x).value + m.nodes[static_cast<std::size_t>(node)].axis_height;
}

/// Catenary of the same weights between the ends, the lower one first: segments are parts, and half
/// of each node's weight lies on either side.
Catenary like(const LineModel& m, bool turned, bool bed) {
  Catenary out;
  const auto n = static_cast<std::size_t>(m.n());
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = turned ? n - 1 - k : k;
    const LineSegment& seg = m.segments[i];
    const double w = 0.5 * (net_weight(m, m.nodes[i]) * (i == 0 ? 2.0 : 1.0) +
                            net_weight(m, m.nodes[i + 1]) * (i + 1 == n ? 2.0 : 1.0));
    out.parts.push_back({seg.length, w / seg.length, seg.stiffness});
  }
  out.loads.assign(n - 1, {});
  out.bed = bed;
  return out;
}

/// Straight shape from the first end to the second, with a sag that gives about the right length.
void straight(const LineModel& m, const Vector3& a, const Vector3& b, VectorX& places) {
  const double all = m.nodes.back().at, chord = (b - a).norm();
  double weight = 0.0;
  for (const LineNode& node : m.nodes)
    weight += net_weight(m, node);
  const double sag = 0.6 * std::sqrt(std::max(0.0, all * all - chord * chord)) *
                     (weight > 0.0   ? 1.0
                      : weight < 0.0 ? -1.0
                                     : 0.0);
  for (int i = 1; i <= m.n_unknown(); ++i) {
    const double s = m.nodes[static_cast<std::size_t>(i)].at / all;
    places.segment<3>(3 * (i - 1)) = a + s * (b - a) - 4.0 * sag * s * (1.0 - s) * Vector3::UnitZ();
  }
}

/// Shape of the catenary; false if no catenary fits.
bool hang(const LineModel& m, const Vector3& a, const Vector3& b, VectorX& places) {
  const bool turned = b[2] < a[2];
  const Vector3 &low = turned ? b : a, &high = turned ? a : b;
  const bool bed = low[2] <= m.bed_at<double>(low).value + 0.01 * m.nodes.back().at;
  const Catenary line = like(m, turned, bed);
  for (const LinePart& part : line.parts)
    if (part.weight == 0.0 || (bed && part.weight < 0.0))
      return false;
  const Vector3 d = high - low;
  const double X = std::hypot(d[0], d[1]);
  const CatenaryHold found = hold(line, X, d[2]);
  if (!std::isfinite(found.vertical) || !std::isfinite(found.horizontal))
    return false;
  const Vector3 e = X > 0.0 ? Vector3(d[0] / X, d[1] / X, 0.0) : Vector3(1.0, 0.0, 0.0);
  std::vector<double> s;
  for (const LineNode& node : m.nodes)
    s.push_back(turned ? m.nodes.back().at - node.at : node.at);
  if (turned)
    std::reverse(s.begin(), s.end());
  const std::vector<LinePoint> points = profile(line, found, X, s);
  for (int i = 1; i <= m.n_unknown(); ++i) {
    const LinePoint& p = points[static_cast<std::size_t>(turned ? m.n() - i : i)];
    places.segment<3>(3 * (i - 1)) = low + p.x * e + p.z * Vector3::UnitZ();
  }
  return places.allFinite();
}

/// Shape down, or up, from end A, and along the seabed.
void drop(const LineModel& m, const Vector3& a, const Vector3& towards, VectorX& places) {
  Vector3 e(towards[0] - a[0], towards[1] - a[1], 0.0);
  e = e.norm() > 0.0 ? Vector3(e.normalized()) : Vector3(1.0, 0.0, 0.0);
  double weight = 0.0;
  for (const LineNode& node : m.nodes)
    weight += net_weight(m, node);
  const double room = weight >= 0.0 ? std::max(0.0, a[2] - m.bed_at<double>(a).value) : HUGE_VAL;
  for (int i = 1; i <= m.n_unknown(); ++i) {
    const double s = m.nodes[static_cast<std::size_t>(i)].at, down = std::min(s, room);
    places.segment<3>(3 * (i - 1)) =
        a + (s - down) * e - (weight >= 0.0 ? down : -down) * Vector3::UnitZ();
  }
}

/// Spreads nodes at one place, on the seabed beside a slack line, evenly on the way to the next
/// node elsewhere. Without such a node they alternate across the line.
void spread(const LineModel& m, const Vector3& a, const Vector3& b, VectorX& places) {
  constexpr double together = 1e-3, aside = 0.1; // of a segment
  const int n = m.n_unknown(), last = m.free_end ? n : n + 1;
  const auto at = [&](int i) {
    return i == 0 ? a : i > n ? b : Vector3(places.segment<3>(3 * (i - 1)));
  };
  const auto length = [&](int i) { return m.segments[static_cast<std::size_t>(i)].length; };
  const auto meets = [&](int i) { return (at(i + 1) - at(i)).norm() < together * length(i); };
  for (int i = 0; i < last; ++i) {
    if (!meets(i))
      continue;
    int end = i + 1; // nodes i + 1 .. end - 1 move
    while (end < last && meets(end))
      ++end;
    end = std::min(end + 1, last);
    const Vector3 from = at(i), way = at(end) - from;
    const bool none = way.norm() < together * length(i) * (end - i);
    const Vector3 across = Vector3(-way[1], way[0], 0.0).stableNormalized();
    for (int k = i + 1; k < end; ++k) {
      places.segment<3>(3 * (k - 1)) = from + way * (k - i) / (end - i);
      if (none)
        places.segment<3>(3 * (k - 1)) += (k % 2 ? aside : -aside) * length(i) *
                                          (across.norm() > 0.5 ? across : Vector3::UnitY());
    }
    i = end - 1;
  }
}

} // namespace

VectorX line_shape(const LineModel& m, const double* x, const Vector3& free_end) {
  const Vector3 a = Eigen::Map<const Vector3>(x);
  VectorX places(3 * m.n_unknown());
  if (m.free_end) {
    drop(m, a, free_end, places);
  } else {
    const Vector3 b = Eigen::Map<const Vector3>(x + 3);
    if (!hang(m, a, b, places))
      straight(m, a, b, places);
    spread(m, a, b, places);
  }
  for (int i = 0; i < m.n_unknown(); ++i)
    places[3 * i + 2] =
        std::max(places[3 * i + 2], resting_height(m, places.segment<3>(3 * i), i + 1));
  return places;
}

} // namespace hydrodae::line
