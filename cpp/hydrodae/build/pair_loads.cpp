#include "hydrodae/build/pair_loads.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::build {

namespace {

constexpr double same = 1e-6;    ///< of headings [rad]
constexpr double slack_w = 1e-9; ///< of frequencies, relative
/// Programs print periods with five digits: a wave as near to a table frequency has its value.
constexpr double printed = 1e-5;

/// Different headings, ascending; where they go round in steps of at most the widest gap, the first
/// again a full turn on, so that interpolation is periodic.
VectorX different_headings(const hydro::SecondOrderTable& table) {
  std::vector<double> all(table.heading1.begin(), table.heading1.end());
  all.insert(all.end(), table.heading2.begin(), table.heading2.end());
  std::sort(all.begin(), all.end());
  std::vector<double> out;
  double gap = 0.0;
  for (const double heading : all)
    if (out.empty() || heading - out.back() > same) {
      gap = out.empty() ? 0.0 : std::max(gap, heading - out.back());
      out.push_back(heading);
    }
  const double across = out.front() + 2.0 * pi - out.back();
  if (out.size() > 2 && across > same && across < gap + same)
    out.push_back(out.front() + 2.0 * pi);
  return Eigen::Map<const VectorX>(out.data(), std::ssize(out));
}

bool alike(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)) < same; }

/// Neighbours in a table of frequencies and the weight of the upper one.
struct Place {
  Index low = 0, high = 0;
  double weight = 0.0;
};

Place place(const VectorX& table, double omega) {
  if (table.size() == 1 || omega <= table[0])
    return {};
  const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, omega);
  const Index high = above - table.begin();
  const double step = table[high] - table[high - 1], near = printed * omega / step;
  const double x = (omega - table[high - 1]) / step;
  return {high - 1, high, x < near ? 0.0 : x > 1.0 - near ? 1.0 : x};
}

/// A product in which a load that is not computed (NaN) does not count where its weight is zero.
template <class T> T weighted(double weight, T value) {
  return weight == 0.0 ? T(0) : weight * value;
}

} // namespace

PairTable::PairTable(const hydro::Database& db, const hydro::SecondOrderTable& table,
                     const hydro::DatabaseBody& body)
    : db_(db), table_(table), body_(body), headings_(different_headings(table)) {
  for (int c = 0; c < 6; ++c) {
    const std::string label =
        body.name + "." + std::string(hydro::rigid_dofs[static_cast<std::size_t>(c)]);
    const auto found = std::find(table.coordinates.begin(), table.coordinates.end(), label);
    column_[static_cast<std::size_t>(c)] =
        found == table.coordinates.end() ? -1 : found - table.coordinates.begin();
  }
  const VectorX& own = headings_.table();
  pair_ = Eigen::MatrixXi::Constant(own.size(), own.size(), -1);
  for (Index p = 0; p < own.size(); ++p)
    for (Index q = 0; q < own.size(); ++q)
      for (Index h = 0; h < table.heading1.size(); ++h)
        if (alike(own[p], table.heading1[h]) && alike(own[q], table.heading2[h])) {
          pair_(p, q) = static_cast<int>(h);
          crossed_ = crossed_ || !alike(own[p], own[q]);
        }
  // A moment is no less than that of the largest force at 1/k of the shortest wave (deep water):
  // the yaw of a body of revolution is rounding alone.
  const double fastest = table.omega[table.omega.size() - 1], force = largest(0),
               moment = std::max(largest(3), force * db.gravity / (fastest * fastest));
  for (int c = 0; c < 6; ++c)
    if (loads(c))
      check_orders(c, c < 3 ? force : moment);
}

/// Largest computed load on the coordinates c, c+1, c+2.
double PairTable::largest(int c) const {
  double out = 0.0;
  for (int end = c + 3; c < end; ++c)
    for (std::size_t k = 0; loads(c) && k < table_.values.size(); ++k)
      if (table_.computed[k] &&
          static_cast<Index>(k % table_.coordinates.size()) == column_[static_cast<std::size_t>(c)])
        out = std::max(out, std::abs(table_.values[k]));
  return out;
}

/// Two waves load alike in either order: T_ji = conj T_ij of differences, T_ij of sums; the load of
/// a wave with itself is real. Differences are judged against the largest force, or moment.
void PairTable::check_orders(int c, double largest) const {
  constexpr double noise = 1e-3; // of tables, as in the symmetry of headings (docs/axes.md)
  const Index column = column_[static_cast<std::size_t>(c)], n = table_.omega.size();
  double worst = 0.0;
  std::array<std::complex<double>, 2> at_worst{};
  Index first = 0, second = 0;
  const Index nh = headings_.table().size();
  for (Index p = 0; p < nh; ++p)
    for (Index q = 0; q < nh; ++q)
      for (Index i = 0; i < n; ++i)
        for (Index j = table_.one_axis() ? i : 0; j < (table_.one_axis() ? i + 1 : n); ++j) {
          const auto both = both_orders(i, j, p, q, column);
          const double gap = std::abs(both[0] - both[1]); // NaN if one is not computed
          if (gap > worst) {
            worst = gap;
            at_worst = both;
            first = i;
            second = j;
          }
        }
  if (!(worst > noise * largest))
    return;
  const auto text = [](const std::complex<double>& load) {
    return number_text(load.real()) + " + " + number_text(load.imag()) + "i";
  };
  const std::string what =
      first == second ? "of two equal waves of " + number_text(table_.omega[first]) + " rad/s"
                      : "of waves of " + number_text(table_.omega[first]) + " and " +
                            number_text(table_.omega[second]) + " rad/s";
  throw ModelError("second_order.loads",
                   "the table " + in_quotes(table_.kind) + " of " + db_.path + " has the load " +
                       text(at_worst[0]) + " " + what + " on " +
                       table_.coordinates[static_cast<std::size_t>(column)] + ", and " +
                       text(at_worst[1]) +
                       " from the same waves in the other order: they must be equal, and a mean "
                       "is real; import it again from its source");
}

bool PairTable::covers(double omega) const {
  return omega >= table_.omega[0] * (1.0 - slack_w) &&
         omega <= table_.omega[table_.omega.size() - 1] * (1.0 + slack_w);
}

std::array<std::complex<double>, 2> PairTable::both_orders(Index i, Index j, Index p, Index q,
                                                           Index column) const {
  const auto stored = [&](Index a, Index b, int h) -> std::complex<double> {
    if (h < 0)
      return NAN;
    const std::size_t k = table_.at(a, b, h, column);
    return table_.computed[k] ? table_.values[k] : NAN;
  };
  const std::complex<double> mate = stored(j, i, pair_(q, p));
  return {stored(i, j, pair_(p, q)), table_.symmetric() ? mate : std::conj(mate)};
}

/// Mean of both orders, or the one that is computed; NaN where neither is.
std::complex<double> PairTable::value(Index i, Index j, Index p, Index q, Index column) const {
  const auto [own, mate] = both_orders(i, j, p, q, column);
  if (std::isnan(own.real()))
    return mate;
  return std::isnan(mate.real()) ? own : 0.5 * (own + mate);
}

/// T of all frequencies of the table at two of its headings, phases at the reference point.
Eigen::MatrixXcd PairTable::cube(Index p, Index q, int c) const {
  const Index n = table_.omega.size();
  const Vector3& point = body_.reference_point;
  const auto lag = [&](Index i, Index h) {
    const double heading = headings_.table()[h];
    return sea::wavenumber(table_.omega[i], db_.water_depth, db_.gravity) *
           (point[0] * std::cos(heading) + point[1] * std::sin(heading));
  };
  Eigen::MatrixXcd out(n, table_.one_axis() ? 1 : n);
  for (Index j = 0; j < out.cols(); ++j)
    for (Index i = 0; i < n; ++i) {
      const double second = table_.one_axis() ? lag(i, q) : lag(j, q);
      out(i, j) = value(i, table_.one_axis() ? i : j, p, q, column_[static_cast<std::size_t>(c)]) *
                  std::polar(1.0, lag(i, p) + (table_.symmetric() ? second : -second));
    }
  return out;
}

void PairTable::refuse_missing(int c, double first, double second) const {
  throw ModelError(
      "second_order.loads",
      "the table " + in_quotes(table_.kind) + " of " + db_.path + " is not computed for " +
          table_.coordinates[static_cast<std::size_t>(column_[static_cast<std::size_t>(c)])] +
          " at " + number_text(first) + " and " + number_text(second) +
          " rad/s, where the sea has waves; another 'frequency_range' of the waves, or "
          "import a complete table");
}

Eigen::MatrixXcd PairTable::pairs(int c, const VectorX& omega, const VectorX& relative) const {
  const Index n = omega.size(), nh = headings_.table().size();
  MatrixX weights(nh, n);
  std::vector<Place> places;
  for (Index i = 0; i < n; ++i) {
    weights.col(i) = headings_.weights(*headings_.covered(relative[i]));
    places.push_back(place(table_.omega, omega[i]));
  }
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(n, n);
  for (Index p = 0; p < nh; ++p)
    for (Index q = 0; q < nh; ++q) {
      if ((!crossed_ && p != q) || weights.row(p).isZero(0.0) || weights.row(q).isZero(0.0))
        continue;
      const Eigen::MatrixXcd T = cube(p, q, c);
      for (Index j = 0; j < n; ++j) {
        const Place& b = places[static_cast<std::size_t>(j)];
        const double second = crossed_ ? weights(q, j) : 1.0;
        if (second == 0.0)
          continue;
        for (Index i = 0; i < n; ++i) {
          const Place& a = places[static_cast<std::size_t>(i)];
          const double w = weights(p, i) * second;
          if (w == 0.0)
            continue;
          out(i, j) += w * (weighted((1.0 - a.weight) * (1.0 - b.weight), T(a.low, b.low)) +
                            weighted(a.weight * (1.0 - b.weight), T(a.high, b.low)) +
                            weighted((1.0 - a.weight) * b.weight, T(a.low, b.high)) +
                            weighted(a.weight * b.weight, T(a.high, b.high)));
        }
      }
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      if (!std::isfinite(out(i, j).real()) || !std::isfinite(out(i, j).imag()))
        refuse_missing(c, omega[i], omega[j]);
  return out;
}

VectorX PairTable::single(int c, const VectorX& omega, const VectorX& relative) const {
  VectorX out = VectorX::Zero(omega.size());
  std::vector<VectorX> diagonal;
  for (Index p = 0; p < headings_.table().size(); ++p) {
    const Eigen::MatrixXcd T = cube(p, p, c);
    diagonal.emplace_back(table_.one_axis() ? VectorX(T.col(0).real())
                                            : VectorX(T.diagonal().real()));
  }
  for (Index i = 0; i < omega.size(); ++i) {
    const VectorX weights = headings_.weights(*headings_.covered(relative[i]));
    const Place a = place(table_.omega, omega[i]);
    for (std::size_t p = 0; p < diagonal.size(); ++p)
      out[i] +=
          weighted(weights[static_cast<Index>(p)], weighted(1.0 - a.weight, diagonal[p][a.low]) +
                                                       weighted(a.weight, diagonal[p][a.high]));
    if (!std::isfinite(out[i]))
      refuse_missing(c, omega[i], omega[i]);
  }
  return out;
}

} // namespace hydrodae::build
