/// Loads of pairs of waves as few products of linear signals, computed ahead of the run.
///
/// The table T of a coordinate, weighted by the amplitudes, is M_ij = A_i conj(A_j) T_ij of
/// differences (Hermitian), A_i A_j T_ij of sums (symmetric). With its eigenvalues s_r and
/// eigenvectors v_r the load is sum_r s_r |u_r|^2, or Re sum_r s_r u_r^2 (sea/quadratic.h; Kac and
/// Siegert 1947, Naess 1986). Products that are left out change the load by an rms of at most
/// (sum s_r^2)^(1/2), for |R|_F^2 = sum s_r^2 of what is left out, and the mean by sum s_r, which
/// `offset` gives back. The rms of the load about its mean is (sum_{i != j} |M_ij|^2)^(1/2).
/// Newman's approximation (D_i + D_j) / 2, D the diagonal, has the two products
/// (g +- l e) / (4 l)^(1/2), g_i = D_i A_i, e_i = A_i, for any signs of D.

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "hydrodae/build/pair_loads.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/math/takagi.h"
#include "hydrodae/water/slow_drift.h"

namespace hydrodae::build {

namespace {

const std::string loads_key = "second_order.loads";

/// Errors, as parts of the rms of each load: of the products, and of their table over time.
struct Accuracy {
  double products, table;
};

Accuracy accuracy(const model::SecondOrder& options) {
  return options.terms == "few" ? Accuracy{9e-4, 1e-5} : Accuracy{1e-10, 1e-9};
}

/// The waves that the tables cover, as a body meets them.
struct Met {
  VectorX omega, relative;    ///< frequency, heading relative to the body at yaw zero [rad]
  Eigen::VectorXcd amplitude; ///< at the body
};

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

/// A load of the case with the table that it takes.
struct Load {
  std::string word;
  const hydro::SecondOrderTable* table;
  bool pairs() const { return word == "difference" || word == "sum"; }
};

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
      throw ModelError(loads_key, "loads = [" + in_quotes(word) + "] needs a table of " +
                                      (pairs ? word + "s of two waves" : "the mean drift") +
                                      ", and " + db.path +
                                      " has none; hydrodae hdb import writes "
                                      "it from the files of its source (docs/databases.md)");
    out.push_back({word, table});
  }
  return out;
}

bool covers(const std::vector<Load>& loads, double omega) {
  constexpr double slack = 1e-9; // relative
  return std::all_of(loads.begin(), loads.end(), [&](const Load& load) {
    const VectorX& w = load.table->omega;
    return omega >= w[0] * (1.0 - slack) && omega <= w[w.size() - 1] * (1.0 + slack);
  });
}

/// The waves whose frequencies all tables have. Throws ModelError where too much is lost.
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
bool one_heading(const std::vector<sea::Component>& waves) {
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
      throw ModelError(loads_key, "a wave travels towards " + degrees(c.heading) +
                                      (yaw != 0.0 ? " less the yaw of the body" : "") +
                                      ", outside the headings of the table " +
                                      in_quotes(load.table->kind) + ", " + degrees(own[0]) +
                                      " to " + degrees(own[own.size() - 1]) +
                                      "; set 'heading_deg' of the wave, or import a table with it");
  if (load.pairs() && !table.crossed() && !one_heading(waves))
    throw ModelError(loads_key, "the waves travel in several directions, and the table " +
                                    in_quotes(load.table->kind) +
                                    " has pairs of equal headings alone; import one with pairs of "
                                    "headings, or use loads = [\"newman\"], which needs none");
  constexpr Index most = 3000; // M of so many waves takes 144 MB
  if (load.pairs() && std::ssize(waves) > most)
    throw ModelError(loads_key, "a table of pairs of " + std::to_string(waves.size()) +
                                    " waves is too large, at most " + std::to_string(most) +
                                    "; use fewer 'components', or loads = [\"newman\"]");
}

/// What a load is before its products: M of pairs, or the diagonal.
struct Weighted {
  Eigen::MatrixXcd M; ///< of `pairs`
  VectorX D;          ///< of the others
};

Weighted weighted_table(const PairTable& table, const Load& load, int c, const Met& waves,
                        double yaw) {
  const VectorX relative = waves.relative.array() - yaw;
  if (!load.pairs())
    return {{}, table.single(c, waves.omega, relative)};
  const Eigen::MatrixXcd T = table.pairs(c, waves.omega, relative);
  const Eigen::VectorXcd& A = waves.amplitude;
  if (load.word == "sum")
    return {A.asDiagonal() * T * A.asDiagonal(), {}};
  return {A.asDiagonal() * T * A.conjugate().asDiagonal(), {}};
}

/// Mean square of the load: about its mean, or where it has no more, of the mean.
double mean_square(const Weighted& w, const Load& load, const Met& waves) {
  const VectorX a2 = waves.amplitude.cwiseAbs2();
  if (load.word == "mean")
    return std::pow(w.D.dot(a2), 2);
  if (load.word == "newman") { // sum_ij |D_i + D_j|^2 / 4 a_i^2 a_j^2
    const VectorX Da = w.D.cwiseProduct(a2);
    return 0.5 * (w.D.cwiseAbs2().dot(a2) * a2.sum() + std::pow(Da.sum(), 2));
  }
  const double all = w.M.cwiseAbs2().sum();
  if (load.word == "sum")
    return 0.5 * all;
  const double slow = all - w.M.diagonal().cwiseAbs2().sum();
  return slow > 1e-12 * all ? slow : all;
}

sea::QuadraticForm quadratic_form(const Weighted& w, const Load& load, const Met& waves,
                                  double squares) {
  sea::QuadraticForm out;
  out.v.resize(0, waves.omega.size());
  const Eigen::VectorXcd& A = waves.amplitude;
  if (load.word == "mean") {
    out.offset = w.D.dot(A.cwiseAbs2());
    return out;
  }
  if (load.word == "newman") {
    const Eigen::VectorXcd g = w.D.cwiseProduct(A);
    const double ratio = g.norm() / A.norm();
    if (!(ratio > 0.0))
      return out;
    out.s.resize(2);
    out.s << 0.25 / ratio, -0.25 / ratio;
    out.v.resize(2, A.size());
    out.v << (g + ratio * A).transpose(), (g - ratio * A).transpose();
    return out;
  }
  out.sum = load.word == "sum";
  Products products = out.sum ? symmetric_products(w.M) : hermitian_products(w.M);
  truncate(products, squares);
  if (!out.sum)
    out.offset = w.M.diagonal().real().sum() - products.s.sum();
  out.s = std::move(products.s);
  out.v = std::move(products.v);
  return out;
}

/// Yaws at which tables are taken, as those of the excitation (excitation_terms.h). The phases of
/// the waves at the body do not depend on its yaw.
YawSamples table_samples(const hydro::Headings& headings, const Meeting& body,
                         const std::vector<sea::Component>& waves) {
  YawSamples out;
  out.yaws = VectorX::Constant(1, body.yaw);
  out.transform = MatrixX::Ones(1, 1);
  if (!body.yaws)
    return out;
  water::YawFunctions& f = out.functions;
  f.round = headings.round();
  if (!f.round) {
    double below = -INFINITY, above = INFINITY;
    const VectorX& own = headings.table();
    for (const sea::Component& c : waves) {
      const double relative = *headings.covered(c.heading - body.yaw);
      below = std::max(below, relative - own[own.size() - 1]);
      above = std::min(above, relative - own[0]);
    }
    f.middle = body.yaw + 0.5 * (above + below);
    f.half = 0.5 * (above - below);
    constexpr double one_yaw = 1e-9; // [rad]
    if (f.half < one_yaw)
      return out;
  }
  // Twice what equal steps resolve, for the splines of others.
  const double wanted = 2.0 * static_cast<double>(headings.table().size());
  const auto n = 2 * static_cast<Index>(0.5 * std::min<double>(wanted, f.most - 1)) + 1;
  f.count = static_cast<int>(n);
  out.yaws.resize(n);
  out.transform.resize(n, n);
  for (Index k = 0; k < n; ++k) {
    const auto at = static_cast<double>(k), count = static_cast<double>(n);
    const double angle = f.round ? 2.0 * pi * at / count : pi * (at + 0.5) / count;
    out.yaws[k] = f.round ? angle : f.middle + f.half * std::cos(angle);
    out.transform(0, k) = 1.0 / count;
    for (Index m = 1; m < n; ++m) {
      const double order = static_cast<double>(f.round ? (m + 1) / 2 : m);
      const bool sine = f.round && m % 2 == 0;
      out.transform(m, k) =
          2.0 / count * (sine ? std::sin(order * angle) : std::cos(order * angle));
    }
  }
  return out;
}

/// The functions of time of all bodies: of coordinates that move, and of the others.
struct Forms {
  std::vector<sea::QuadraticForm> moving, still;
};

/// All that one body has from one load.
void add_load(const PairTable& table, const Load& load, int number, const Met& waves,
              const YawSamples& samples, double part, water::SlowDrift::Body& body, double length,
              Forms& forms) {
  std::array<std::vector<Weighted>, 6> all; // by function of yaw
  std::array<double, 6> squares{};
  double force = 0.0, moment = 0.0;
  for (int c = 0; c < 6; ++c) {
    const auto k = static_cast<std::size_t>(c);
    if (!table.loads(c))
      continue;
    all[k].resize(static_cast<std::size_t>(samples.functions.count));
    for (Index y = 0; y < samples.yaws.size(); ++y) {
      const Weighted at_yaw = weighted_table(table, load, c, waves, samples.yaws[y]);
      for (std::size_t m = 0; m < all[k].size(); ++m) {
        const double factor = samples.transform(static_cast<Index>(m), y);
        if (y == 0)
          all[k][m] = {Eigen::MatrixXcd(factor * at_yaw.M), VectorX(factor * at_yaw.D)};
        else {
          all[k][m].M += factor * at_yaw.M;
          all[k][m].D += factor * at_yaw.D;
        }
      }
    }
    for (const Weighted& w : all[k])
      squares[k] += mean_square(w, load, waves);
    (c < 3 ? force : moment) = std::max(c < 3 ? force : moment, std::sqrt(squares[k]));
  }
  constexpr double left_out = 1e-6; // of the largest of the body: noise of its symmetry
  for (int c = 0; c < 6; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const double least =
        left_out * (c < 3 ? std::max(force, moment / length) : std::max(moment, force * length));
    if (!(std::sqrt(squares[k]) > least))
      continue;
    const bool moves = body.wet.moving[k] >= 0;
    const double allowed = part * part * squares[k] / static_cast<double>(all[k].size());
    for (std::size_t m = 0; m < all[k].size(); ++m) {
      sea::QuadraticForm form = quadratic_form(all[k][m], load, waves, allowed);
      if (form.s.size() == 0 && form.offset == 0.0)
        continue;
      (moves ? body.moving : body.still).list.push_back({c, static_cast<int>(m), number});
      (moves ? forms.moving : forms.still).push_back(std::move(form));
    }
  }
}

/// Waves against which a device is drifted, by the largest of the table.
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

/// Newman's approximation is one for small differences of frequencies.
void note_newman(const PairTable& table, const Load& load, const Met& waves, double yaw,
                 const std::string& body, system::System& s) {
  constexpr double small = 0.2;    // [rad/s]
  constexpr double relevant = 0.1; // of the variance: 5 % of the rms
  if (load.word != "newman" || !table.loads(0))
    return;
  const VectorX D = table.single(0, waves.omega, waves.relative.array() - yaw),
                a2 = waves.amplitude.cwiseAbs2();
  double all = 0.0, beyond = 0.0;
  for (Index i = 0; i < D.size(); ++i)
    for (Index j = 0; j < i; ++j) {
      const double square = std::pow(D[i] + D[j], 2) * a2[i] * a2[j];
      all += square;
      beyond += std::abs(waves.omega[i] - waves.omega[j]) > small ? square : 0.0;
    }
  if (beyond > relevant * all)
    s.notes.push_back("second order, body " + in_quotes(body) +
                      ": Newman's approximation is for "
                      "small differences of frequencies, and " +
                      rounded_text(100.0 * beyond / all, 2) +
                      " % of the variance of its slow surge force lies above 0.2 rad/s");
}

/// The database body of a hydrodynamic body that the tables load; null: they do not.
const hydro::DatabaseBody* loaded_body(const model::Scene& scene, const system::System& s,
                                       std::size_t i, const std::vector<Load>& loads) {
  const system::HydroBody& hb = s.hydro.bodies[i];
  if (static_cast<std::size_t>(hb.carrier) != i)
    return nullptr; // a mode
  const std::string label = hydro_label(scene, hb, 0);
  const std::string name = label.substr(0, label.rfind('.'));
  const auto of_body = [&](const std::string& l) { return l.substr(0, l.rfind('.')) == name; };
  const bool loaded = std::any_of(loads.begin(), loads.end(), [&](const Load& load) {
    return std::any_of(load.table->coordinates.begin(), load.table->coordinates.end(), of_body);
  });
  if (!loaded)
    return nullptr;
  const std::string& own = s.bodies[static_cast<std::size_t>(hb.body)].name;
  for (std::size_t k = 0; k < s.hydro.bodies.size(); ++k)
    if (k != i && static_cast<std::size_t>(s.hydro.bodies[k].carrier) == i)
      throw ModelError(loads_key, "body " + in_quotes(own) +
                                      " has modes, and tables of second order are of a rigid "
                                      "body; leave out [second_order], or [[mode]]");
  if (hb.table >= 0)
    throw ModelError(loads_key, "body " + in_quotes(own) +
                                    " has a [[pose_table]], and the tables of second order are of "
                                    "one pose; leave out one of the two");
  return hydro::find_body(*scene.database, name);
}

} // namespace

void add_second_order(const model::Scene& scene, const Sea& sea, system::System& s) {
  if (!scene.second_order || !scene.database)
    return;
  const std::vector<Load> loads = find_loads(scene);
  const std::vector<sea::Component> waves = covered_waves(scene, sea, loads, s);
  if (waves.empty())
    return;
  const std::vector<Meeting> places = meetings(scene, s);
  const Accuracy wanted = accuracy(*scene.second_order);
  std::vector<water::SlowDrift::Body> bodies;
  std::vector<system::PortData> ports;
  Forms forms;
  for (std::size_t i = 0; i < s.hydro.bodies.size(); ++i) {
    const hydro::DatabaseBody* entry = loaded_body(scene, s, i, loads);
    if (!entry)
      continue;
    const system::HydroBody& hb = s.hydro.bodies[i];
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    water::SlowDrift::Body body{b.name, hb, b.reference, {}, {}, {}};
    body.moving.first = std::ssize(forms.moving);
    body.still.first = std::ssize(forms.still);
    const Met own = met(waves, places[i]);
    VectorX headings;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const PairTable table(*scene.database, *loads[k].table, *entry);
      check_headings(table, loads[k], waves, places[i].yaw);
      const VectorX& its = table.headings().table();
      if (places[i].yaws && k > 0 && (its.size() != headings.size() || !its.isApprox(headings)))
        throw ModelError(loads_key,
                         "axes = \"yaw\" needs the same headings in all tables of second "
                         "order, and those of " +
                             in_quotes(loads[k].table->kind) +
                             " differ; import them for the same headings");
      headings = its;
      const YawSamples samples = table_samples(table.headings(), places[i], waves);
      body.yaw = samples.functions;
      note_maruo(table, loads[k], own, places[i].yaw, b.name, s);
      note_newman(table, loads[k], own, places[i].yaw, b.name, s);
      add_load(table, loads[k], static_cast<int>(k), own, samples, wanted.products, body,
               b.length_scale, forms);
    }
    bodies.push_back(std::move(body));
    system::PortData port;
    port.component = "second_order";
    port.body = hb.body;
    ports.push_back(std::move(port));
  }
  if (bodies.empty())
    throw ModelError(loads_key, "the tables of second order of " + scene.database->path +
                                    " load no body of the case; they load " +
                                    joined(loads[0].table->coordinates));
  auto list = std::make_shared<water::SlowDrift>(s.hydro.axes, std::move(bodies),
                                                 scene.second_order->loads);
  VectorX omega(std::ssize(waves));
  for (std::size_t i = 0; i < waves.size(); ++i)
    omega[static_cast<Index>(i)] = waves[i].omega;
  const auto functions = [&](std::vector<sea::QuadraticForm> list_of) {
    water::SlowDrift::Functions out;
    if (list_of.empty())
      return out;
    if (scene.sea.phase == "fixed")
      out.fixed = sea::QuadraticSignals(omega, std::move(list_of), scene.solver.end_time,
                                        scene.sea.ramp, wanted.table);
    else
      out.drifting = sea::DriftingQuadratic(waves, std::move(list_of), scene.sea.ramp);
    return out;
  };
  list->set(functions(std::move(forms.moving)), functions(std::move(forms.still)));
  s.elements.push_back({std::move(list), std::move(ports), {}});
}

} // namespace hydrodae::build
