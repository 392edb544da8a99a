#include "hydrodae/hydro/frequency.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/hydro/coverage.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::hydro {
namespace {

constexpr double slack = 1e-9; ///< relative tolerance of frequencies

std::vector<double> as_list(const VectorX& values) {
  return {values.data(), values.data() + values.size()};
}

double phase_lag(const Database& db, const Vector3& point, double omega, double heading) {
  return sea::wavenumber(omega, db.water_depth, db.gravity) *
         (point[0] * std::cos(heading) + point[1] * std::sin(heading));
}

} // namespace

Vector3 phase_point(const DatabaseBody& body) {
  const bool floats = body.hydrostatics && body.hydrostatics->displaced_volume > 0.0 &&
                      body.hydrostatics->center_of_buoyancy.allFinite();
  return floats ? body.hydrostatics->center_of_buoyancy : body.reference_point;
}

bool covers_frequency(const Database& database, double omega) {
  return omega >= database.omega[0] * (1.0 - slack) &&
         omega <= database.omega[database.omega.size() - 1] * (1.0 + slack);
}

Excitation::Excitation(const Database& database, const std::vector<Eigen::MatrixXcd>& table,
                       const std::vector<std::string>& labels)
    : db_(database), headings_(database.heading) {
  const std::vector<double> omega = as_list(db_.omega);
  for (const std::string& label : labels) {
    Row row;
    const auto found = std::find(db_.coordinates.begin(), db_.coordinates.end(), label);
    row.known = found != db_.coordinates.end();
    if (row.known) {
      const auto column = static_cast<Eigen::Index>(found - db_.coordinates.begin());
      row.point = phase_point(*find_body(db_, label.substr(0, label.rfind('.'))));
      for (Eigen::Index h = 0; h < db_.heading.size(); ++h) {
        std::vector<double> real, imaginary;
        for (Eigen::Index w = 0; w < db_.omega.size(); ++w) {
          const std::complex<double> smooth =
              table[static_cast<std::size_t>(h)](w, column) *
              std::polar(1.0, phase_lag(db_, row.point, db_.omega[w], db_.heading[h]));
          real.push_back(smooth.real());
          imaginary.push_back(smooth.imag());
        }
        row.real.emplace_back(omega, real);
        row.imaginary.emplace_back(omega, imaginary);
      }
    }
    rows_.push_back(std::move(row));
  }
}

Eigen::MatrixXcd Excitation::smooth(double omega, Eigen::Index first, Eigen::Index count) const {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(db_.heading.size(), count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const Row& row = rows_[static_cast<std::size_t>(first + r)];
    for (std::size_t h = 0; h < row.real.size(); ++h)
      out(static_cast<Eigen::Index>(h), r) = {row.real[h](omega)[0], row.imaginary[h](omega)[0]};
  }
  return out;
}

Eigen::VectorXcd Excitation::operator()(double omega, double heading) const {
  Eigen::VectorXcd force = smooth(omega).transpose() * headings_.weights(heading);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    force[static_cast<Eigen::Index>(r)] *=
        std::polar(1.0, -phase_lag(db_, rows_[r].point, omega, heading));
  return force;
}

MatrixX at_frequency(const Database& database, const std::vector<MatrixX>& table, double omega) {
  const std::vector<double> grid = as_list(database.omega);
  MatrixX out(table.front().rows(), table.front().cols());
  std::vector<double> values(grid.size());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    for (std::size_t w = 0; w < grid.size(); ++w)
      values[w] = table[w].data()[k];
    out.data()[k] = CubicSpline(grid, values)(omega)[0];
  }
  return out;
}

} // namespace hydrodae::hydro
