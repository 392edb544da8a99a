#include "hydrodae/build/excitation_terms.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/hydro/symmetry.h"

namespace hydrodae::build {

namespace {

constexpr double left_out = 1e-6; ///< negligible terms, as part of the largest term of the body

/// Highest harmonic of exp(-i z cos b) above 1e-7: Bessel functions J_m(z) decrease like Ai(2^(1/3)
/// (m - z) / z^(1/3)) beyond m = z.
double harmonics_of_phase(double z) {
  return z > 0.0 ? std::ceil(z + 6.0 * std::cbrt(z) + 4.0) : 0;
}

double arm(const hydro::Excitation& table, std::size_t label, const Meeting& body) {
  return (table.point(label) - body.database_point).head<2>().norm();
}

/// Sets the interval of yaw in which all components are within the headings of a sector.
void set_interval(const hydro::Headings& headings, const Meeting& body,
                  const std::vector<sea::Component>& components, water::YawFunctions& out) {
  const VectorX& table = headings.table();
  double below = -INFINITY, above = INFINITY; // limits relative to the mean yaw
  for (const sea::Component& c : components) {
    const double relative = *headings.covered(c.heading - body.yaw);
    below = std::max(below, relative - table[table.size() - 1]);
    above = std::min(above, relative - table[0]);
  }
  out.middle = body.yaw + 0.5 * (above + below);
  out.half = 0.5 * (above - below);
}

} // namespace

hydro::Database wave_tables(const model::Scene& scene, const system::System& system,
                            std::string& symmetry) {
  hydro::Database out = *scene.database;
  symmetry = system.hydro.axes == system::HydroAxes::yaw ? hydro::add_images(out) : "";
  return out;
}

YawSamples yaw_samples(const hydro::Excitation& table, std::size_t first_label, const Meeting& body,
                       const std::vector<sea::Component>& components) {
  return yaw_samples(table.headings(), arm(table, first_label, body), body, components);
}

YawSamples yaw_samples(const hydro::Headings& headings, double lever, const Meeting& body,
                       const std::vector<sea::Component>& components) {
  YawSamples out;
  out.yaws = VectorX::Constant(1, body.yaw);
  out.transform = MatrixX::Ones(1, 1);
  if (!body.yaws)
    return out;
  water::YawFunctions& f = out.functions;
  f.round = headings.round();
  if (!f.round)
    set_interval(headings, body, components, f);
  constexpr double one_yaw = 1e-9; // [rad]
  if (!f.round && f.half < one_yaw)
    return out;
  double z = 0.0;
  for (const sea::Component& c : components)
    z = std::max(z, c.wavenumber * lever);
  // Twice what equal steps resolve, for the splines of others.
  const double wanted =
      2.0 * (static_cast<double>(headings.table().size()) + harmonics_of_phase(z));
  const auto n = 2 * static_cast<Index>(0.5 * std::min<double>(wanted, f.most - 1)) + 1;
  f.count = static_cast<int>(n);
  out.yaws.resize(n);
  out.transform.resize(n, n);
  for (Index k = 0; k < n; ++k) {
    const auto place = static_cast<double>(k), count = static_cast<double>(n);
    const double angle = f.round ? 2.0 * pi * place / count : pi * (place + 0.5) / count;
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

Eigen::MatrixXcd yaw_coefficients(const hydro::Excitation& table, std::size_t first_label,
                                  const Meeting& body, const YawSamples& samples,
                                  const std::vector<sea::Component>& components) {
  const hydro::Headings& headings = table.headings();
  const auto first = static_cast<Index>(first_label);
  const Index n = samples.yaws.size();
  const Vector3 lever = table.point(first_label) - body.database_point;
  MatrixX weights(n, headings.table().size());
  VectorX along(n); // position along the lever, in the direction of the waves
  double heading = NAN;
  Eigen::MatrixXcd out(6 * n, std::ssize(components));
  for (Index i = 0; i < out.cols(); ++i) {
    const sea::Component& c = components[static_cast<std::size_t>(i)];
    if (c.heading != heading) {
      heading = c.heading;
      for (Index k = 0; k < n; ++k) {
        // A node may lie outside the table by rounding.
        const double relative = heading - samples.yaws[k];
        weights.row(k) = headings.weights(*headings.covered(relative)).transpose();
        along[k] = lever[0] * std::cos(relative) + lever[1] * std::sin(relative);
      }
    }
    Eigen::MatrixXcd force = weights * table.smooth(c.omega, first, 6);
    const double lag =
        c.wavenumber * (body.point[0] * std::cos(heading) + body.point[1] * std::sin(heading));
    for (Index k = 0; k < n; ++k)
      force.row(k) *= std::polar(c.amplitude, c.phase - lag - c.wavenumber * along[k]);
    out.col(i) = (samples.transform * force).reshaped();
  }
  return out;
}

std::vector<water::Excitation::Term> terms_that_matter(const Eigen::MatrixXcd& coefficients,
                                                       const water::YawFunctions& functions,
                                                       double length) {
  const Index count = functions.count;
  const VectorX size = coefficients.rowwise().norm();
  const auto of = [&](Index c) { return size.segment(c * count, count).norm(); };
  double force = 0.0, moment = 0.0;
  for (Index c = 0; c < 6; ++c)
    (c < 3 ? force : moment) = std::max(c < 3 ? force : moment, of(c));
  std::vector<water::Excitation::Term> out;
  for (Index c = 0; c < 6; ++c) {
    const double least =
        left_out * (c < 3 ? std::max(force, moment / length) : std::max(moment, force * length));
    // Cosine and sine of one order are kept together, so that all directions are equal.
    for (Index m = 0, n = 1; m < count; m += n) {
      n = functions.round && m > 0 ? 2 : 1;
      if (count == 1 || size.segment(c * count + m, n).norm() > least)
        for (Index k = m; k < m + n; ++k)
          out.push_back({static_cast<int>(c), static_cast<int>(k)});
    }
  }
  return out;
}

} // namespace hydrodae::build
