#include "hydrodae/hydro/symmetry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "hydrodae/hydro/coverage.h"
#include "hydrodae/hydro/headings.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::hydro {
namespace {

using Complex = std::complex<double>;

/// Largest difference, as part of the largest value of a coordinate
constexpr double equal = 1e-3;
constexpr double equal_damping = 5e-2; ///< mean over the frequencies, weighted by the damping
constexpr double noise = 1e-5;         ///< noise, as part of the largest value of a unit
constexpr double same_place = 1e-6;    ///< [m], [rad]
constexpr double same_step = 1e-2;     ///< files round degrees, relative
constexpr std::array<const char*, 6> dofs = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

/// A coordinate of the database: body and which of the six.
struct Coordinate {
  const DatabaseBody* body = nullptr;
  int dof = 0;
  bool turns() const { return dof >= 3; }
};

std::optional<std::vector<Coordinate>> coordinates_of(const Database& db) {
  std::vector<Coordinate> out;
  for (const std::string& label : db.coordinates) {
    const std::size_t dot = label.rfind('.');
    const auto dof = std::find(dofs.begin(), dofs.end(), label.substr(dot + 1));
    if (dof == dofs.end())
      return std::nullopt; // a generalised mode: of no known symmetry
    out.push_back({find_body(db, label.substr(0, dot)), static_cast<int>(dof - dofs.begin())});
  }
  return out;
}

/// What a horizontal map M makes of the coordinates: image_i = sign_i of `from_i`. Forces are polar
/// vectors, moments axial ones.
struct Image {
  Eigen::Matrix2d map = Eigen::Matrix2d::Identity();
  std::vector<Eigen::Index> from;
  VectorX sign;

  double heading(double b) const {
    const Eigen::Vector2d ahead = map * Eigen::Vector2d(std::cos(b), std::sin(b));
    return std::atan2(ahead[1], ahead[0]);
  }
  Eigen::MatrixXcd of(const Eigen::MatrixXcd& force) const {
    Eigen::MatrixXcd out(force.rows(), force.cols());
    for (Eigen::Index i = 0; i < force.cols(); ++i)
      out.col(i) = sign[i] * force.col(from[static_cast<std::size_t>(i)]);
    return out;
  }
  /// First this one, then the other.
  Image then(const Image& other) const {
    Image out{other.map * map, {}, other.sign};
    for (Eigen::Index i = 0; i < sign.size(); ++i) {
      const Eigen::Index k = other.from[static_cast<std::size_t>(i)];
      out.from.push_back(from[static_cast<std::size_t>(k)]);
      out.sign[i] *= sign[k];
    }
    return out;
  }
};

/// The body at the image of a place, itself before others; null: none.
const DatabaseBody* body_at(const Database& db, const DatabaseBody& itself, const Vector3& place) {
  const auto there = [&](const DatabaseBody& b) {
    return (b.reference_point - place).norm() <= same_place * (1.0 + place.norm());
  };
  if (there(itself))
    return &itself;
  const auto found = std::find_if(db.bodies.begin(), db.bodies.end(), there);
  return found == db.bodies.end() ? nullptr : &*found;
}

/// The image under M; empty where a coordinate lacks one.
std::optional<Image> image_under(const Database& db, const std::vector<Coordinate>& all,
                                 const Eigen::Matrix2d& M) {
  const double det = M.determinant();
  Matrix6 T = Matrix6::Zero();
  T.topLeftCorner<2, 2>() = M;
  T(2, 2) = 1.0;
  T.block<2, 2>(3, 3) = det * M;
  T(5, 5) = det;
  Image out{M, {}, VectorX(std::ssize(all))};
  for (const Coordinate& c : all) {
    Vector3 place = c.body->reference_point;
    place.head<2>() = M.transpose() * place.head<2>();
    const DatabaseBody* source = body_at(db, *c.body, place);
    Eigen::Index dof = 0;
    T.row(c.dof).cwiseAbs().maxCoeff(&dof);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Coordinate& other) {
      return other.body == source && other.dof == dof;
    });
    if (!source || found == all.end())
      return std::nullopt;
    out.sign[std::ssize(out.from)] = T(c.dof, dof);
    out.from.push_back(found - all.begin());
  }
  return out;
}

/// Size of the largest body, (A / rho)^(1/3) [m].
double lever(const Database& db, const std::vector<Coordinate>& all) {
  double largest = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto k = static_cast<Eigen::Index>(i); !all[i].turns())
      largest = std::max(largest, db.added_mass_inf(k, k));
  return std::cbrt(largest / db.rho);
}

/// The largest value of each kind, forces and moments; a force at its lever is a moment.
std::array<double, 2> units(const std::vector<Coordinate>& all, const VectorX& largest,
                            double moment) {
  std::array<double, 2> unit{};
  for (std::size_t i = 0; i < all.size(); ++i)
    unit[all[i].turns()] = std::max(unit[all[i].turns()], largest[static_cast<Eigen::Index>(i)]);
  unit[1] = std::max(unit[1], moment * unit[0]);
  return unit;
}

/// What is small for each coordinate, from its largest values and those of its unit; `moment`: what
/// moments are of forces, by the lever.
VectorX small(const std::vector<Coordinate>& all, const VectorX& largest, double moment,
              double share) {
  const std::array<double, 2> unit = units(all, largest, moment);
  VectorX out(largest.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out[k] = std::max(share * largest[k], noise * unit[all[i].turns()]);
  }
  return out;
}

VectorX largest_forces(const Database& db) {
  VectorX out = VectorX::Zero(std::ssize(db.coordinates));
  for (const Eigen::MatrixXcd& force : db.excitation)
    out = out.cwiseMax(force.cwiseAbs().colwise().maxCoeff().transpose());
  return out;
}

bool alike(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b, const VectorX& off) {
  return ((a - b).cwiseAbs().colwise().maxCoeff().transpose() - off).maxCoeff() <= 0.0;
}

bool keeps_added_mass(const Database& db, const std::vector<Coordinate>& all, const Image& image) {
  const MatrixX& A = db.added_mass_inf;
  const VectorX own = A.diagonal().cwiseAbs();
  VectorX largest = own;
  for (Eigen::Index i = 0; i < own.size(); ++i)
    largest[i] = std::max(own[i], own[image.from[static_cast<std::size_t>(i)]]);
  const double arm = lever(db, all);
  const VectorX off = (small(all, largest, arm * arm, equal) / equal).cwiseSqrt();
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double other =
          A(image.from[static_cast<std::size_t>(i)], image.from[static_cast<std::size_t>(j)]);
      if (!(std::abs(A(i, j) - image.sign[i] * image.sign[j] * other) <= equal * off[i] * off[j]))
        return false;
    }
  return true;
}

/// Returns whether the forces of all pairs of headings that are images agree, and there is a pair.
bool keeps_forces(const Database& db, const Image& image, const VectorX& off) {
  bool any = false;
  for (Eigen::Index h = 0; h < db.heading.size(); ++h)
    for (Eigen::Index k = 0; k < db.heading.size(); ++k) {
      if (std::abs(std::remainder(image.heading(db.heading[h]) - db.heading[k], 2.0 * pi)) >
          same_place)
        continue;
      any = true;
      if (!alike(image.of(db.excitation[static_cast<std::size_t>(h)]),
                 db.excitation[static_cast<std::size_t>(k)], off))
        return false;
    }
  return any;
}

/// Forces turned about z, where each body has both of a pair or neither.
Eigen::MatrixXcd turned(const std::vector<Coordinate>& all, const Image& quarter,
                        const Eigen::MatrixXcd& force, double angle) {
  Eigen::MatrixXcd out = force;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].dof % 3 != 2) { // of a vector (x, y): cos a of its own, sin a of the quarter turn
      const auto k = static_cast<Eigen::Index>(i);
      out.col(k) = std::cos(angle) * force.col(k) +
                   std::sin(angle) * quarter.sign[k] * force.col(quarter.from[i]);
    }
  return out;
}

/// Group velocity c_g = dw/dk [m/s].
double group_velocity(const Database& db, double omega, double k) {
  const double kh = k * db.water_depth;
  return 0.5 * omega / k * (1.0 + (kh < 50.0 ? 2.0 * kh / std::sinh(2.0 * kh) : 0.0));
}

/// What a force of heading 0, turned round, radiates, against the damping of the database: the mean
/// difference over the frequencies, weighted by the damping, of the coordinate that is off most.
double radiation_miss(const Database& db, const std::vector<Coordinate>& all, const Image& quarter,
                      const Eigen::MatrixXcd& ahead) {
  if (std::ssize(db.damping) != db.omega.size())
    return INFINITY;
  MatrixX B(db.omega.size(), ahead.cols()), expected(B.rows(), B.cols());
  for (Eigen::Index w = 0; w < B.rows(); ++w) {
    B.row(w) = db.damping[static_cast<std::size_t>(w)].diagonal().transpose();
    const double k = sea::wavenumber(db.omega[w], db.water_depth, db.gravity);
    const double factor = k / (8.0 * pi * db.rho * db.gravity * group_velocity(db, db.omega[w], k));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      const double squares = all[i].dof % 3 == 2
                                 ? 2.0 * std::norm(ahead(w, c))
                                 : std::norm(ahead(w, c)) + std::norm(ahead(w, quarter.from[i]));
      expected(w, c) = factor * pi * squares;
    }
  }
  const VectorX largest = B.cwiseAbs().colwise().maxCoeff().transpose();
  const double arm = lever(db, all);
  const std::array<double, 2> unit = units(all, largest, arm * arm);
  double out = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    if (largest[c] > equal * unit[all[i].turns()])
      out = std::max(out, (expected - B).col(c).cwiseAbs().dot(B.col(c).cwiseAbs()) /
                              B.col(c).squaredNorm());
  }
  return out;
}

const Eigen::Matrix2d& plane_y() {
  static const Eigen::Matrix2d M = Eigen::Vector2d(1.0, -1.0).asDiagonal();
  return M;
}

/// Bodies of revolution: a circle of headings from the first of the table.
bool revolve(Database& db, const std::vector<Coordinate>& all) {
  const Eigen::Matrix2d turn = (Eigen::Matrix2d() << 0.0, -1.0, 1.0, 0.0).finished();
  const std::optional<Image> quarter = image_under(db, all, turn),
                             mirror = image_under(db, all, plane_y());
  for (const DatabaseBody& b : db.bodies)
    if (b.reference_point.head<2>().norm() > same_place)
      return false;
  if (!quarter || !mirror || !keeps_added_mass(db, all, *quarter) ||
      !keeps_added_mass(db, all, *mirror))
    return false;
  const VectorX off = small(all, largest_forces(db), lever(db, all), equal);
  const auto ahead = [&](const std::vector<Eigen::MatrixXcd>& table, Eigen::Index h) {
    return turned(all, *quarter, table[static_cast<std::size_t>(h)], -db.heading[h]);
  };
  const Eigen::MatrixXcd first = ahead(db.excitation, 0);
  if (!alike(mirror->of(first), first, 2.0 * off) ||
      !(radiation_miss(db, all, *quarter, first) <= equal_damping))
    return false;
  for (Eigen::Index h = 1; h < db.heading.size(); ++h)
    if (!alike(ahead(db.excitation, h), first, 2.0 * off))
      return false;
  constexpr Eigen::Index steps = 8;
  const auto round = [&](const std::vector<Eigen::MatrixXcd>& table) {
    std::vector<Eigen::MatrixXcd> out;
    if (!table.empty())
      for (Eigen::Index k = 0; k <= steps; ++k)
        out.push_back(turned(all, *quarter, ahead(table, 0),
                             db.heading[0] + 2.0 * pi * static_cast<double>(k % steps) / steps));
    return out;
  };
  std::vector<Eigen::MatrixXcd> excitation = round(db.excitation), part = round(db.froude_krylov);
  db.heading = VectorX(db.heading[0] + VectorX::LinSpaced(steps + 1, 0.0, 2.0 * pi).array());
  db.excitation = std::move(excitation);
  db.froude_krylov = std::move(part);
  return true;
}

/// A heading of the larger table: the image of one that is there.
struct Found {
  double heading = 0.0;
  std::size_t row = 0;
  const Image* image = nullptr; ///< null: itself
};

/// Headings of the table and the images that go on from its ends at steps of its widest at most;
/// the first, a full turn on, once more where they go round.
std::vector<Found> going_on(const VectorX& heading, const std::vector<Found>& images) {
  const Eigen::Index n = heading.size();
  std::vector<Found> out;
  for (Eigen::Index h = 0; h < n; ++h)
    out.push_back({heading[h], static_cast<std::size_t>(h), nullptr});
  if (n < 2)
    return out;
  const double widest = (1.0 + same_step) * (heading.tail(n - 1) - heading.head(n - 1)).maxCoeff();
  if (widest > (1.0 + same_step) * (1.0 + same_step) * 0.5 * pi)
    return out;
  const auto next = [&](double from, int way) {
    std::pair<const Found*, double> nearest{nullptr, widest};
    for (const Found& f : images) {
      double step = std::remainder(way * (f.heading - from), 2.0 * pi);
      if (step > same_place && step <= nearest.second)
        nearest = {&f, step};
    }
    return nearest;
  };
  const auto room = [&] { return 2.0 * pi - (out.back().heading - out.front().heading); };
  for (const int way : {1, -1})
    while (room() > widest) {
      const double from = way > 0 ? out.back().heading : out.front().heading;
      const auto [found, step] = next(from, way);
      if (!found || step > room() - same_place)
        break;
      out.insert(way > 0 ? out.end() : out.begin(),
                 Found{from + way * step, found->row, found->image});
    }
  if (room() <= widest)
    out.push_back({out.front().heading + 2.0 * pi, out.front().row, out.front().image});
  return out;
}

/// Mirror images about the planes that the tables show. @returns the planes in words
std::string mirror(Database& db, const std::vector<Coordinate>& all) {
  const VectorX off = small(all, largest_forces(db), lever(db, all), equal);
  std::vector<Image> images;
  std::string words;
  const std::pair<Eigen::Matrix2d, const char*> planes[] = {{plane_y(), "y = 0"},
                                                            {-plane_y(), "x = 0"}};
  for (const auto& [map, name] : planes) {
    const std::optional<Image> image = image_under(db, all, map);
    if (!image || !keeps_added_mass(db, all, *image) || !keeps_forces(db, *image, off))
      continue;
    images.push_back(*image);
    words += (words.empty() ? "the plane " : " and the plane ") + std::string(name);
  }
  if (images.empty())
    return "";
  if (images.size() == 2)
    images.push_back(images[0].then(images[1]));
  std::vector<Found> candidates;
  for (const Image& image : images)
    for (Eigen::Index h = 0; h < db.heading.size(); ++h)
      candidates.push_back({image.heading(db.heading[h]), static_cast<std::size_t>(h), &image});
  const std::vector<Found> found = going_on(db.heading, candidates);
  if (std::ssize(found) == db.heading.size())
    return "";
  const auto larger = [&](const std::vector<Eigen::MatrixXcd>& table) {
    std::vector<Eigen::MatrixXcd> out;
    if (!table.empty())
      for (const Found& f : found)
        out.push_back(f.image ? f.image->of(table[f.row]) : table[f.row]);
    return out;
  };
  db.excitation = larger(db.excitation);
  db.froude_krylov = larger(db.froude_krylov);
  db.heading.resize(std::ssize(found));
  for (std::size_t k = 0; k < found.size(); ++k)
    db.heading[static_cast<Eigen::Index>(k)] = found[k].heading;
  return words;
}

} // namespace

std::string add_images(Database& db) {
  if (db.heading.size() == 0 || (db.heading.size() > 1 && Headings(db.heading).round()))
    return "";
  const auto all = coordinates_of(db);
  if (!all)
    return "";
  return revolve(db, *all) ? "revolution about z" : mirror(db, *all);
}

} // namespace hydrodae::hydro
