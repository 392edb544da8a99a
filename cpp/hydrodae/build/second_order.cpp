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

#include "hydrodae/build/second_order_checks.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/math/takagi.h"
#include "hydrodae/water/slow_drift.h"

namespace hydrodae::build {

namespace {

/// Errors, as parts of the rms of each load: of the products, and of their table over time.
struct Accuracy {
  double products, table;
};

Accuracy accuracy(const model::SecondOrder& options) {
  // Errors add as squares; that of the table has an rms of half its tolerance (sea/quadratic.h).
  return options.terms == "few" ? Accuracy{8e-4, 1e-3} : Accuracy{1e-10, 1e-9};
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
      throw ModelError(second_order_key,
                       "body " + in_quotes(own) +
                           " has modes, and tables of second order are of a rigid "
                           "body; leave out [second_order], or [[mode]]");
  if (hb.table >= 0)
    throw ModelError(second_order_key,
                     "body " + in_quotes(own) +
                         " has a [[pose_table]], and the tables of second order are of "
                         "one pose; leave out one of the two");
  return hydro::find_body(*scene.database, name);
}

/// The loads of all tables on hydrodynamic body i, their functions of time behind those in `forms`.
water::SlowDrift::Body loads_on_body(const model::Scene& scene, system::System& s, std::size_t i,
                                     const hydro::DatabaseBody& entry,
                                     const std::vector<Load>& loads,
                                     const std::vector<sea::Component>& waves, const Meeting& place,
                                     Forms& forms) {
  const system::HydroBody& hb = s.hydro.bodies[i];
  const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
  water::SlowDrift::Body body{b.name, hb, b.reference, {}, {}, {}};
  body.moving.first = std::ssize(forms.moving);
  body.still.first = std::ssize(forms.still);
  const Met own = met(waves, place);
  VectorX headings;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const PairTable table(*scene.database, *loads[k].table, entry);
    check_headings(table, loads[k], waves, place.yaw);
    const VectorX& its = table.headings().table();
    if (place.yaws && k > 0 && (its.size() != headings.size() || !its.isApprox(headings)))
      throw ModelError(second_order_key,
                       "axes = \"yaw\" needs the same headings in all tables of second "
                       "order, and those of " +
                           in_quotes(loads[k].table->kind) +
                           " differ; import them for the same headings");
    headings = its;
    const YawSamples samples = yaw_samples(table.headings(), 0.0, place, waves);
    body.yaw = samples.functions;
    note_maruo(table, loads[k], own, place.yaw, b.name, s);
    note_newman(table, loads[k], own, place.yaw, b.name, s);
    add_load(table, loads[k], static_cast<int>(k), own, samples,
             accuracy(*scene.second_order).products, body, b.length_scale, forms);
  }
  return body;
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
  std::vector<water::SlowDrift::Body> bodies;
  std::vector<system::PortData> ports;
  Forms forms;
  for (std::size_t i = 0; i < s.hydro.bodies.size(); ++i) {
    const hydro::DatabaseBody* entry = loaded_body(scene, s, i, loads);
    if (!entry)
      continue;
    bodies.push_back(loads_on_body(scene, s, i, *entry, loads, waves, places[i], forms));
    system::PortData port;
    port.component = "second_order";
    port.body = s.hydro.bodies[i].body;
    ports.push_back(std::move(port));
  }
  if (bodies.empty())
    throw ModelError(second_order_key, "the tables of second order of " + scene.database->path +
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
                                        scene.sea.ramp, accuracy(*scene.second_order).table);
    else
      out.drifting = sea::DriftingQuadratic(waves, std::move(list_of), scene.sea.ramp);
    return out;
  };
  list->set(functions(std::move(forms.moving)), functions(std::move(forms.still)));
  s.elements.push_back({std::move(list), std::move(ports), {}});
}

} // namespace hydrodae::build
