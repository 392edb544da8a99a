#include "hydrodae/build/second_order_checks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/core/text.h"

namespace hydrodae::build {

Met met(const std::vector<sea::Component>& waves, const Meeting& body) {
  const Index n = std::ssize(waves);
  Met out{VectorX(n), VectorX(n), Eigen::VectorXcd(n)};
  for (Index i = 0; i < n; ++i) {
    const sea::Component& c = waves[static_cast<std::size_t>(i)];
    out.omega[i] = c.omega;
    out.relative[i] = c.heading;
    out.amplitude[i] =
        std::polar(c.amplitude, c.phase - c.wavenumber * (body.point[0] * std::cos(c.heading) +
                                                          body.point[1] * std::sin(c.heading)));
  }
  return out;
}

std::vector<Load> find_loads(const model::Scene& scene) {
  const hydro::Database& db = *scene.database;
  const auto find = [&](const std::string& kind) -> const hydro::SecondOrderTable* {
    for (const hydro::SecondOrderTable& table : db.second_order)
      if (table.kind == kind)
        return &table;
    return nullptr;
  };
  std::vector<Load> out;
  for (const std::string& word : scene.second_order->loads) {
    const bool pairs = word == "difference" || word == "sum";
    const hydro::SecondOrderTable* table = pairs ? find(word) : find("mean");
    if (!table && !pairs)
      table = find("difference");
    if (!table)
      throw ModelError(second_order_key, "loads = [" + in_quotes(word) + "] needs a table of " +
                                             (pairs ? word + "s of two waves" : "the mean drift") +
                                             ", and " + db.path +
                                             " lacks it; hydrodae hdb import writes "
                                             "it from the files of its source (docs/databases.md)");
    out.push_back({word, table});
  }
  return out;
}

static bool covers(const std::vector<Load>& loads, double omega) {
  constexpr double slack = 1e-9; // relative
  return std::all_of(loads.begin(), loads.end(), [&](const Load& load) {
    const VectorX& w = load.table->omega;
    return omega >= w[0] * (1.0 - slack) && omega <= w[w.size() - 1] * (1.0 + slack);
  });
}

std::vector<sea::Component> covered_waves(const model::Scene& scene, const Sea& sea,
                                          const std::vector<Load>& loads, system::System& s) {
  std::vector<sea::Component> out;
  double all = 0.0, lost = 0.0;
  for (const sea::Component& c : sea.all) {
    all += c.amplitude * c.amplitude;
    if (covers(loads, c.omega))
      out.push_back(c);
    else
      lost += c.amplitude * c.amplitude;
  }
  if (!(lost > 0.0))
    return out;
  double low = 0.0, high = INFINITY;
  for (const Load& load : loads) {
    low = std::max(low, load.table->omega[0]);
    high = std::min(high, load.table->omega[load.table->omega.size() - 1]);
  }
  const std::string text = rounded_text(100.0 * lost / all, 2) +
                           " % of the variance of the waves lies outside the frequencies of the "
                           "tables of second order, " +
                           number_text(low) + " to " + number_text(high) + " rad/s";
  if (lost > scene.second_order->lost_variance * all)
    throw ModelError(
        "second_order.lost_variance",
        text + ", more than lost_variance = " + number_text(scene.second_order->lost_variance) +
            " allows; set 'frequency_range' of the waves, or import a table of more "
            "frequencies");
  s.notes.push_back("second order: " + text);
  return out;
}

/// Do all waves travel alike?
static bool one_heading(const std::vector<sea::Component>& waves) {
  constexpr double same = 1e-6; // [rad]
  return std::all_of(waves.begin(), waves.end(), [&](const sea::Component& c) {
    return std::abs(std::remainder(c.heading - waves[0].heading, 2.0 * pi)) < same;
  });
}

void check_headings(const PairTable& table, const Load& load,
                    const std::vector<sea::Component>& waves, double yaw) {
  const auto degrees = [](double angle) { return number_text(angle * 180.0 / pi) + " deg"; };
  const VectorX& own = table.headings().table();
  for (const sea::Component& c : waves)
    if (!table.headings().covered(c.heading - yaw))
      throw ModelError(second_order_key,
                       "a wave travels towards " + degrees(c.heading) +
                           (yaw != 0.0 ? " less the yaw of the body" : "") +
                           ", outside the headings of the table " + in_quotes(load.table->kind) +
                           ", " + degrees(own[0]) + " to " + degrees(own[own.size() - 1]) +
                           "; set 'heading_deg' of the wave, or import a table with it");
  if (load.pairs() && !table.crossed() && !one_heading(waves))
    throw ModelError(second_order_key,
                     "the waves travel in several directions, and the table " +
                         in_quotes(load.table->kind) +
                         " has pairs of equal headings alone; import one with pairs of "
                         "headings, or use loads = [\"newman\"], which needs none");
  constexpr Index most = 3000; // M of so many waves takes 144 MB
  if (load.pairs() && std::ssize(waves) > most)
    throw ModelError(second_order_key, "a table of pairs of " + std::to_string(waves.size()) +
                                           " waves is too large, at most " + std::to_string(most) +
                                           "; use fewer 'components', or loads = [\"newman\"]");
}

// Judged by the largest drift of the table.
void note_maruo(const PairTable& table, const Load& load, const Met& waves, double yaw,
                const std::string& body, system::System& s) {
  constexpr double noise = 1e-3;
  if (load.word == "sum" || !table.loads(0))
    return;
  const VectorX relative = waves.relative.array() - yaw;
  const VectorX x = table.single(0, waves.omega, relative);
  const VectorX y =
      table.loads(1) ? table.single(1, waves.omega, relative) : VectorX::Zero(x.size());
  const VectorX along = x.cwiseProduct(relative.array().cos().matrix()) +
                        y.cwiseProduct(relative.array().sin().matrix());
  const double largest = along.cwiseAbs().maxCoeff(), worst = along.minCoeff();
  const auto against = (along.array() < -noise * largest).count();
  if (against > 0)
    s.notes.push_back(
        "second order, body " + in_quotes(body) + ": the mean drift is against " +
        rounded_text(100.0 * static_cast<double>(against) / static_cast<double>(along.size()), 2) +
        " % of the waves, at worst " + number_text(worst) +
        " N/m2, which no body without a source of power has (Maruo 1960)");
}

void note_newman(const PairTable& table, const Load& load, const Met& waves, double yaw,
                 const std::string& body, system::System& s) {
  constexpr double small = 0.2;    // [rad/s]
  constexpr double relevant = 0.1; // of the variance: 5 % of the rms
  if (load.word != "newman" || !table.loads(0))
    return;
  const VectorX D = table.single(0, waves.omega, waves.relative.array() - yaw),
                a2 = waves.amplitude.cwiseAbs2();
  std::vector<Index> order(static_cast<std::size_t>(D.size())); // by frequency
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index i, Index j) { return waves.omega[i] < waves.omega[j]; });
  // (D_i + D_j)^2 a_i^2 a_j^2 over the waves j before i: sums of a^2, D a^2 and D^2 a^2.
  struct Sums {
    double a2 = 0.0, Da2 = 0.0, D2a2 = 0.0;
    void add(double d, double square) {
      a2 += square;
      Da2 += d * square;
      D2a2 += d * d * square;
    }
    double with(double d, double square) const {
      return square * (d * d * a2 + 2.0 * d * Da2 + D2a2);
    }
  } before, far;
  double all = 0.0, beyond = 0.0;
  auto next_far = order.begin();
  for (const Index i : order) {
    for (; waves.omega[*next_far] < waves.omega[i] - small; ++next_far)
      far.add(D[*next_far], a2[*next_far]);
    all += before.with(D[i], a2[i]);
    beyond += far.with(D[i], a2[i]);
    before.add(D[i], a2[i]);
  }
  if (beyond > relevant * all)
    s.notes.push_back("second order, body " + in_quotes(body) +
                      ": Newman's approximation is for "
                      "small differences of frequencies, and " +
                      rounded_text(100.0 * beyond / all, 2) +
                      " % of the variance of its slow surge force lies above 0.2 rad/s");
}

} // namespace hydrodae::build
