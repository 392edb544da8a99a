#include "hydrodae/line/line_statics.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/line/line_table.h"
#include "hydrodae/math/band_matrix.h"

namespace hydrodae::line {

namespace {

/// Accelerations of the nodes at rest, with their derivatives.
class Rest {
public:
  Rest(const LineModel& m, const sea::WaveField& sea, const double* x)
      : m_(m), table_(m), sea_(sea), x_(x), still_(VectorX::Zero(3 * m.n_points())),
        z(VectorX::Zero(6 * m.n_unknown())), load(VectorX::Zero(3 * m.n_points())),
        rates_(z.size()), sparsity_(line_sparsity(m)),
        values_(static_cast<Index>(sparsity_.size())), matrix_(3 * m.n_unknown(), m.bends ? 8 : 5) {
  }

  void place(const VectorX& places) {
    for (int i = 0; i < m_.n_unknown(); ++i)
      z.segment<3>(6 * i) = places.segment<3>(3 * i);
  }
  VectorX accelerations() {
    evaluate_line(table_, view(), sea_, 0.0, arrays_, load.data(), rates_.data());
    VectorX out(3 * m_.n_unknown());
    for (int i = 0; i < m_.n_unknown(); ++i)
      out.segment<3>(3 * i) = rates_.segment<3>(6 * i + 3);
    return out;
  }
  /// Forces on the nodes that move, at the places of the last `accelerations`.
  VectorX forces() {
    VectorX out(3 * m_.n_unknown());
    for (int i = 0; i < m_.n_unknown(); ++i)
      out.segment<3>(3 * i) = arrays_.force(i + 1);
    return out;
  }
  /// Solves (-d accelerations / d places + sigma) x = a in place. @returns whether that is possible
  bool solve(double sigma, Eigen::Ref<MatrixX> a) {
    if (!factorise(sigma))
      return false;
    matrix_.solve(a);
    return true;
  }
  /// Derivatives of the load by the ends, with the nodes in equilibrium. @returns whether they
  /// exist
  bool slope(double sigma, MatrixX& out) {
    if (!factorise(sigma))
      return false;
    const int w = 3 * m_.n_points(), n = 3 * m_.n_unknown();
    MatrixX nodes = MatrixX::Zero(n, w), by_nodes = MatrixX::Zero(w, n);
    out = MatrixX::Zero(w, w);
    for_each_derivative([&](int i, int j, double value) {
      if (i < w && j < w)
        out(i, j) = value;
      else if (i < w)
        by_nodes(i, j - w) = value;
      else if (j < w)
        nodes(i - w, j) = value;
    });
    matrix_.solve(nodes);
    out += by_nodes * nodes;
    return true;
  }
  double largest_tension() const {
    double most = 0.0;
    for (int k = 0; k < m_.n(); ++k)
      most = std::max(most, std::abs(segment_pull<double>(view(), k).tension));
    return most;
  }
  LineView<double> view() const { return {m_, x_, still_.data(), z.data()}; }

private:
  /// Visits d (load, acceleration) / d (end, node) at the places of the last `accelerations`, by
  /// row and column, ends first.
  template <class Visit> void for_each_derivative(Visit&& visit) const {
    const int w = 3 * m_.n_points();
    for (std::size_t k = 0; k < sparsity_.size(); ++k) {
      const auto [row, column] = sparsity_[k];
      const int r = row - w, c = column - 2 * w;
      if ((r >= 0 && r % 6 < 3) || (c >= 0 && c % 6 >= 3) || (c < 0 && column >= w))
        continue; // skips rows of places and columns of velocities
      visit(r < 0 ? row : w + 3 * (r / 6) + r % 6 - 3, c < 0 ? column : w + 3 * (c / 6) + c % 6,
            values_[static_cast<Index>(k)]);
    }
  }
  bool factorise(double sigma) {
    line_jacobian(view(), sea_, 0.0, rates_.data(), blocks_, values_.data());
    const int w = 3 * m_.n_points();
    matrix_.set_zero();
    for_each_derivative([&](int i, int j, double value) {
      if (i >= w && j >= w)
        matrix_(i - w, j - w) = (i == j ? sigma : 0.0) - value;
    });
    return matrix_.factorise();
  }

  const LineModel& m_;
  LineTable table_;
  LineArrays<double> arrays_;
  const sea::WaveField& sea_;
  const double* x_;
  VectorX still_;

public:
  VectorX z, load;

private:
  VectorX rates_;
  std::vector<std::array<int, 2>> sparsity_;
  VectorX values_;
  BandMatrix matrix_; ///< a force reaches one node on either side, two in a line that bends
  LineBlocks blocks_;
};

/// Largest unbalanced force over mass.
double largest_of(const VectorX& a) { return a.allFinite() ? a.cwiseAbs().maxCoeff() : HUGE_VAL; }

/// Newton's method with limited steps. For large EA the accelerations grow before they shrink, so
/// they do not control the steps.
/// @returns whether the line came to rest
bool find_directly(Rest& rest, VectorX& places, double longest, double enough, double floor) {
  constexpr int most_steps = 40;
  double before = HUGE_VAL;
  for (int step = 0; step < most_steps; ++step) {
    rest.place(places);
    const VectorX a = rest.accelerations();
    const double now = largest_of(a);
    if (now <= enough || (now <= floor && now >= 0.5 * before))
      return true;
    before = now;
    VectorX change = a;
    if (!std::isfinite(now) || !rest.solve(0.0, change))
      return false;
    const double most = largest_of(change);
    if (!std::isfinite(most))
      return false;
    places += std::min(1.0, longest / most) * change;
  }
  return false;
}

/// Minimises the energy, which is convex without bending: elastic segments that only pull, weight,
/// the bed. Steps (K + sigma M) d = f continue while f . d is positive along them.
/// @returns whether the line came to rest
bool descend(Rest& rest, VectorX& places, double longest, double start, double enough,
             double floor) {
  constexpr int most_steps = 400, most_cuts = 30;
  double sigma = start, before = HUGE_VAL;
  for (int step = 0; step < most_steps; ++step) {
    rest.place(places);
    const VectorX a = rest.accelerations();
    const double now = largest_of(a);
    if (now <= enough || (now <= floor && now >= 0.5 * before))
      return true;
    before = now;
    const VectorX f = rest.forces();
    VectorX d = a;
    rest.solve(sigma, d);
    double slope = f.dot(d);
    if (!(slope > 0.0) || !d.allFinite()) { // no descent: a shorter step along the accelerations
      sigma = std::max(10.0 * sigma, start);
      d = a / sigma;
      slope = f.dot(d);
    }
    if (const double most = largest_of(d); most > longest) {
      d *= longest / most;
      slope *= longest / most;
    }
    // bounds: f . d is positive at `low`, and not at `high`
    double part = 1.0, low = 0.0, high = 0.0;
    for (int cut = 0; cut < most_cuts; ++cut) {
      rest.place(places + part * d);
      const double there = rest.accelerations().allFinite() ? rest.forces().dot(d) : -HUGE_VAL;
      if (std::abs(there) <= 0.5 * slope || (there > 0.0 && part == 1.0))
        break;
      (there > 0.0 ? low : high) = part;
      part = 0.5 * (low + high);
    }
    places += part * d;
    sigma *= part == 1.0 ? 0.2 : part > 0.3 ? 1.0 : 3.0;
    if (sigma < 1e-9 * start)
      sigma = 0.0;
    else if (sigma > 1e6 * start)
      return false;
  }
  return false;
}

/// Scales of a line at rest.
struct RestScales {
  double g = 1.0, shortest = HUGE_VAL, whole = 0.0, weight = 0.0, stiffest = 0.0, floor = 0.0;

  RestScales(const LineModel& m, const VectorX& places) : whole(m.nodes.back().at) {
    double least_mass = HUGE_VAL, per_length = 0.0;
    g = m.gravity > 0.0 ? m.gravity : 1.0;
    for (const LineSegment& seg : m.segments) {
      shortest = std::min(shortest, seg.length);
      stiffest = std::max(stiffest, seg.stiffness);
      per_length = std::max(per_length, seg.stiffness / seg.length);
    }
    for (const LineNode& node : m.nodes) {
      least_mass = std::min(least_mass, node.mass);
      weight += std::abs(node.mass * g - node.lift - node.body_lift);
    }
    // Rounding error of the places.
    const double reach = whole + places.cwiseAbs().maxCoeff();
    floor = std::max(1e-11 * g, 20.0 * 2.2e-16 * reach * per_length / least_mass);
  }
};

/// Finds places near rest with a sequence of stiffer lines, beginning with one so soft that it
/// stretches by a part of its length.
void stiffen(const LineModel& m, const sea::WaveField& sea, const double* x, const RestScales& size,
             VectorX& places) {
  constexpr double strain = 0.1;
  double part = std::min(1.0, size.weight / (strain * size.stiffest));
  for (; part < 0.5; part *= 10.0) {
    LineModel soft = m;
    for (LineSegment& segment : soft.segments) {
      segment.stiffness *= part;
      segment.slack = std::min(segment.slack / part, strain);
      segment.damping = 0.0;
    }
    Rest rest(soft, sea, x);
    VectorX found = places;
    descend(rest, found, 0.1 * size.whole, size.g / size.shortest, 1e-6 * size.g, size.floor);
    places = found;
  }
}

/// Places of the nodes that follow the ends from their last rest.
VectorX follow(const LineModel& m, const double* x, const LineAtRest& before) {
  VectorX places(3 * m.n_unknown());
  for (int i = 1; i <= m.n_unknown(); ++i) {
    const double s = m.free_end ? 0.0 : m.nodes[static_cast<std::size_t>(i)].at / m.nodes.back().at;
    for (int c = 0; c < 3; ++c) {
      const double a = x[c] - before.ends[c], b = m.free_end ? 0.0 : x[3 + c] - before.ends[3 + c];
      places[3 * (i - 1) + c] = before.z[6 * (i - 1) + c] + (1.0 - s) * a + s * b;
    }
  }
  return places;
}

void find_rest(const LineModel& m, const sea::WaveField& sea, const double* x, Rest& rest,
               const Vector3& free_end, const LineAtRest* before, const std::string& name) {
  const bool follows = before && before->z.size() > 0;
  VectorX places = follows ? follow(m, x, *before) : line_shape(m, x, free_end);
  const RestScales size(m, places);
  const auto directly = [&] {
    return find_directly(rest, places, size.shortest, 1e-13 * size.g, size.floor);
  };
  if (follows && directly())
    return;
  const VectorX first = follows ? line_shape(m, x, free_end) : places;
  places = first;
  if (directly())
    return;
  places = first;
  stiffen(m, sea, x, size, places);
  VectorX near = places;
  if (directly())
    return;
  const bool found =
      descend(rest, near, 0.1 * size.whole, size.g / size.shortest, 1e-13 * size.g, size.floor);
  places = near;
  if (found || directly())
    return;
  rest.place(near);
  throw ModelError("force." + name, "line " + in_quotes(name) +
                                        " finds no rest where its ends are: the largest " +
                                        "acceleration that is left is " +
                                        number_text(largest_of(rest.accelerations())) + " m/s2");
}

} // namespace

LineAtRest line_at_rest(const LineModel& m, const sea::WaveField& sea, const double* x,
                        const Vector3& free_end, const std::string& name, bool with_slope,
                        const LineAtRest* before) {
  Rest rest(m, sea, x);
  find_rest(m, sea, x, rest, free_end, before, name);
  LineAtRest out{Eigen::Map<const VectorX>(x, 3 * m.n_points()),
                 rest.z,
                 rest.load,
                 {},
                 rest.largest_tension()};
  if (with_slope) { // a slack segment has no stiffness of its own across
    bool found = rest.slope(0.0, out.slope);
    for (double sigma = 1e-9; !found && sigma < 1.0; sigma *= 10.0)
      found = rest.slope(sigma, out.slope);
    if (!found)
      throw ModelError("force." + name, "line " + in_quotes(name) + " has no stiffness at rest");
  }
  return out;
}

} // namespace hydrodae::line
