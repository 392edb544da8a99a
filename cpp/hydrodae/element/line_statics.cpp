#include "hydrodae/element/line_statics.h"

#include <Eigen/SparseLU>
#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::element {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Accelerations of the nodes at rest, and what they follow from.
class Rest {
public:
  Rest(const LineModel& m, const sea::WaveField& sea, const double* x)
      : m_(m), sea_(sea), x_(x), still_(VectorX::Zero(3 * m.n_points())),
        z(VectorX::Zero(6 * m.n_unknown())), load(VectorX::Zero(3 * m.n_points())),
        rates_(z.size()), force_(3 * (m.n() + 1)), sparsity_(line_sparsity(m)),
        values_(static_cast<Index>(sparsity_.size())) {}

  void place(const VectorX& places) {
    for (int i = 0; i < m_.n_unknown(); ++i)
      z.segment<3>(6 * i) = places.segment<3>(3 * i);
  }
  VectorX accelerations() {
    evaluate_line<double>(view(), sea_, 0.0, force_.data(), load.data(), rates_.data());
    VectorX out(3 * m_.n_unknown());
    for (int i = 0; i < m_.n_unknown(); ++i)
      out.segment<3>(3 * i) = rates_.segment<3>(6 * i + 3);
    return out;
  }
  /// -d accelerations / d places + sigma; by the ends' places, and the loads by both.
  Sparse matrix(double sigma) {
    line_jacobian(view(), sea_, 0.0, rates_.data(), blocks_, values_.data());
    std::vector<Eigen::Triplet<double>> entries;
    const int w = 3 * m_.n_points(), n = 3 * m_.n_unknown();
    by_end = MatrixX::Zero(n, w);
    load_by_end = MatrixX::Zero(w, w);
    load_by_node = MatrixX::Zero(w, n);
    for (std::size_t k = 0; k < sparsity_.size(); ++k) {
      const auto [row, column] = sparsity_[k];
      const int r = row - w, c = column - 2 * w;
      const double value = values_[static_cast<Index>(k)];
      if ((r >= 0 && r % 6 < 3) || (c >= 0 && c % 6 >= 3) || (c < 0 && column >= w))
        continue; // rows of places, columns of velocities
      const int i = 3 * (r / 6) + r % 6 - 3, j = 3 * (c / 6) + c % 6;
      if (r >= 0 && c >= 0)
        entries.emplace_back(i, j, -value);
      else if (r >= 0)
        by_end(i, column) = value;
      else if (c >= 0)
        load_by_node(row, j) = value;
      else
        load_by_end(row, column) = value;
    }
    for (int i = 0; i < n; ++i)
      entries.emplace_back(i, i, sigma);
    Sparse out(n, n);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }
  double largest_tension() const {
    double most = 0.0;
    for (int k = 0; k < m_.n(); ++k)
      most = std::max(most, std::abs(segment_pull<double>(view(), k).tension));
    return most;
  }
  LineView<double> view() const { return {m_, x_, still_.data(), z.data()}; }

private:
  const LineModel& m_;
  const sea::WaveField& sea_;
  const double* x_;
  VectorX still_;

public:
  VectorX z, load;
  MatrixX by_end, load_by_end, load_by_node;

private:
  VectorX rates_, force_;
  std::vector<std::array<int, 2>> sparsity_;
  VectorX values_;
  LineBlocks blocks_;
};

/// Largest force that is not in balance, over the mass.
double largest_of(const VectorX& a) { return a.allFinite() ? a.cwiseAbs().maxCoeff() : HUGE_VAL; }

/// Plain Newton with limited steps. Where EA is large the accelerations grow before they shrink, so
/// they say nothing of a step.
/// @returns whether it came to rest
bool find_directly(Rest& rest, VectorX& places, double longest, double enough, double floor) {
  constexpr int most_steps = 40;
  Eigen::SparseLU<Sparse> lu;
  double before = HUGE_VAL;
  for (int step = 0; step < most_steps; ++step) {
    rest.place(places);
    const VectorX a = rest.accelerations();
    const double now = largest_of(a);
    if (now <= enough || (now <= floor && now >= 0.5 * before))
      return true;
    before = now;
    lu.compute(rest.matrix(0.0));
    if (!std::isfinite(now) || lu.info() != Eigen::Success)
      return false;
    VectorX change = lu.solve(a);
    const double most = largest_of(change);
    if (!std::isfinite(most))
      return false;
    places += std::min(1.0, longest / most) * change;
  }
  return false;
}

/// Places near rest: of ever stiffer lines, the first so soft that its chords are not slack where
/// it bends.
void stiffen(const LineModel& m, const sea::WaveField& sea, const double* x, double longest,
             VectorX& places) {
  for (const double part : {1e-3, 1e-2, 1e-1}) {
    LineModel soft = m;
    for (LineSegment& segment : soft.segments) {
      segment.stiffness *= part;
      segment.slack /= part;
    }
    Rest rest(soft, sea, x);
    VectorX found = places;
    if (find_directly(rest, found, longest, 1e-9 * m.gravity, 1e-6 * m.gravity))
      places = found;
  }
}

void find_rest(const LineModel& m, const sea::WaveField& sea, const double* x, Rest& rest,
               VectorX& places, const std::string& name) {
  constexpr int most_steps = 2000, patience = 20;
  double shortest = HUGE_VAL, heaviest = 0.0;
  for (const LineSegment& seg : m.segments)
    shortest = std::min(shortest, seg.length);
  double stiffest = 0.0, least_mass = HUGE_VAL, reach = m.nodes.back().at;
  for (std::size_t k = 0; k < m.segments.size(); ++k)
    stiffest = std::max(stiffest, m.segments[k].stiffness / m.segments[k].length);
  for (const LineNode& node : m.nodes) {
    heaviest = std::max(heaviest, node.mass);
    least_mass = std::min(least_mass, node.mass);
  }
  // What rounding of the places leaves.
  reach += places.cwiseAbs().maxCoeff();
  const double floor = 20.0 * 2.2e-16 * reach * stiffest / least_mass,
               g = m.gravity > 0.0 ? m.gravity : 1.0, start = g / shortest;
  double sigma = 0.0, before = HUGE_VAL, best = HUGE_VAL, least_sigma = start;
  int stale = 0;
  const VectorX first = places;
  if (find_directly(rest, places, shortest, 1e-13 * g, std::max(1e-11 * g, floor)))
    return;
  places = first;
  stiffen(m, sea, x, shortest, places);
  const VectorX near = places;
  if (find_directly(rest, places, shortest, 1e-13 * g, std::max(1e-11 * g, floor)))
    return;
  places = near;
  rest.place(places);
  VectorX a = rest.accelerations();
  double now = largest_of(a);
  Eigen::SparseLU<Sparse> lu;
  for (int step = 0; step < most_steps; ++step) {
    const bool settled = now <= std::max(1e-11 * g, floor);
    if (settled && (now >= 0.5 * before || now <= 1e-13 * g || step > 100))
      return;
    stale = now < 0.9 * best ? 0 : stale + 1;
    best = std::min(best, now);
    if (stale > patience) { // it goes to and fro across a kink: shorter steps
      stale = 0;
      sigma = least_sigma;
      least_sigma *= 10.0;
    }
    lu.compute(rest.matrix(sigma));
    VectorX change = lu.info() == Eigen::Success ? VectorX(lu.solve(a)) : VectorX();
    const bool sound = change.size() > 0 && change.allFinite();
    const double most = sound ? change.cwiseAbs().maxCoeff() : 0.0;
    if (sound && most > 0.5 * shortest)
      change *= 0.5 * shortest / most;
    const VectorX tried = sound ? VectorX(places + change) : places;
    rest.place(tried);
    const VectorX next = rest.accelerations();
    const double then = sound ? largest_of(next) : HUGE_VAL;
    if (then <= 2.0 * now || settled) {
      if (settled && then >= now) {
        rest.place(places);
        rest.accelerations();
        return;
      }
      sigma *= std::clamp(then / now, 0.1, 1.5);
      if (sigma < 1e-6 * start)
        sigma = 0.0;
      places = tried;
      a = next;
      before = now;
      now = then;
    } else {
      sigma = std::max(5.0 * sigma, start);
      rest.place(places);
      rest.accelerations();
    }
  }
  throw ModelError("force." + name,
                   "line " + in_quotes(name) + " finds no rest where its ends are: the largest " +
                       "acceleration that is left is " + number_text(now) + " m/s2");
}

} // namespace

LineAtRest line_at_rest(const LineModel& m, const sea::WaveField& sea, const double* x,
                        const Vector3& free_end, const std::string& name, bool with_slope) {
  VectorX places = line_shape(m, x, free_end);
  Rest rest(m, sea, x);
  find_rest(m, sea, x, rest, places, name);
  LineAtRest out{rest.z, rest.load, {}, rest.largest_tension()};
  if (with_slope) { // a slack piece has no stiffness of its own across
    Eigen::SparseLU<Sparse> lu(rest.matrix(0.0));
    for (double sigma = 1e-9; lu.info() != Eigen::Success && sigma < 1.0; sigma *= 10.0)
      lu.compute(rest.matrix(sigma));
    if (lu.info() != Eigen::Success)
      throw ModelError("force." + name, "line " + in_quotes(name) + " has no stiffness at rest");
    out.slope = rest.load_by_end + rest.load_by_node * MatrixX(lu.solve(rest.by_end));
  }
  return out;
}

} // namespace hydrodae::element
