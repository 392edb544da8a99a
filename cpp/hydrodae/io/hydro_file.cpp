#include "hydrodae/io/hydro_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>

#include "hydrodae/core/text.h"
#include "hydrodae/io/hdf5_input.h"
#include "hydrodae/io/sha256.h"

namespace hydrodae::io {
namespace {

using hdf5::Input;

void check_format(const Input& file) {
  if (!file.has_attribute("/", "format") || file.text("/", "format") != "hydrodae-hydro")
    file.refuse("/", "not a hydrodae-hydro file; make one with: hydrodae hdb import");
  const double format_version = file.number("/", "format_version");
  if (format_version != 1.0)
    file.refuse("/", "format_version is " + number_text(format_version) +
                         ", this program reads 1; make the file again with: hydrodae hdb import");
}

void require_positive(const Input& file, const char* name, double value) {
  if (!(value > 0.0))
    file.refuse("/", std::string(name) + " must be > 0, is " + number_text(value));
}

/// Labels must differ; returns them as a set.
std::set<std::string> label_set(const Input& file, const std::string& dataset,
                                const std::vector<std::string>& labels) {
  std::set<std::string> set;
  for (const std::string& label : labels)
    if (!set.insert(label).second)
      file.refuse(dataset, in_quotes(label) + " stands there twice");
  return set;
}

hydro::DatabaseBody read_body(const Input& file, const std::string& name) {
  const std::string group = "/bodies/" + name;
  hydro::DatabaseBody body;
  body.name = name;
  body.reference_point = file.vector3(group, "reference_point");
  body.column = file.has_attribute(group, "column");
  const std::string stiffness = group + "/hydrostatic_stiffness";
  if (!file.has_object(stiffness) && !file.has_attribute(group, "displaced_volume"))
    return body;
  hydro::Hydrostatics hydrostatics;
  hydrostatics.displaced_volume = file.number(group, "displaced_volume");
  if (!(std::isfinite(hydrostatics.displaced_volume) && hydrostatics.displaced_volume >= 0.0))
    file.refuse(group, "displaced_volume must be >= 0 m3");
  hydrostatics.center_of_buoyancy = file.vector3(group, "center_of_buoyancy");
  hydrostatics.stiffness = file.matrix(stiffness, 6, 6);
  body.hydrostatics = hydrostatics;
  return body;
}

std::vector<hydro::DatabaseBody> read_bodies(const Input& file,
                                             const std::vector<std::string>& coordinates) {
  std::vector<std::pair<double, std::string>> order;
  for (const std::string& name : file.members("/bodies"))
    order.emplace_back(file.number("/bodies/" + name, "index"), name);
  std::sort(order.begin(), order.end());
  std::vector<hydro::DatabaseBody> bodies;
  for (const auto& [index, name] : order)
    bodies.push_back(read_body(file, name));
  for (const std::string& label : coordinates) {
    const std::string owner = label.substr(0, label.rfind('.')),
                      dof = label.substr(label.rfind('.') + 1);
    const auto owns = [&](const hydro::DatabaseBody& body) { return body.name == owner; };
    const auto body = std::find_if(bodies.begin(), bodies.end(), owns);
    if (body == bodies.end())
      file.refuse("/coordinates", in_quotes(label) + " belongs to no group of /bodies");
    if (std::find(hydro::rigid_dofs.begin(), hydro::rigid_dofs.end(), dof) ==
        hydro::rigid_dofs.end())
      body->modes.push_back(dof);
  }
  for (hydro::DatabaseBody& body : bodies) {
    const std::size_t n = 6 + body.modes.size();
    const std::string stiffness = "/bodies/" + body.name + "/mode_stiffness";
    if (n > 6)
      body.mode_stiffness = file.matrix(stiffness, n, n);
  }
  return bodies;
}

/// Decaying poles, one of each conjugate pair; a real pole has real rows.
void check_poles(const Input& file, const std::string& group, const hydro::MemoryFit& fit) {
  for (Eigen::Index k = 0; k < fit.poles.size(); ++k) {
    const std::complex<double> pole = fit.poles[k];
    const std::string text =
        "pole " + number_text(pole.real()) + " + " + number_text(pole.imag()) + "i 1/s ";
    if (!(pole.real() < 0.0))
      file.refuse(group + "/poles", text + "does not decay (Re < 0)");
    if (pole.imag() < 0.0)
      file.refuse(group + "/poles", text + "must have Im >= 0");
    if (pole.imag() > 0.0)
      continue;
    const double inputs = fit.input_matrix.row(k).imag().cwiseAbs().maxCoeff();
    const double outputs = fit.output_matrix.col(k).imag().cwiseAbs().maxCoeff();
    if (inputs > 1e-12 * fit.input_matrix.row(k).cwiseAbs().maxCoeff() ||
        outputs > 1e-12 * fit.output_matrix.col(k).cwiseAbs().maxCoeff())
      file.refuse(group, text + "is real, but its input or output coefficients are not");
  }
}

/// The coordinates that move and those that are loaded, in a group of the file.
void read_labels(const Input& file, const std::string& group,
                 const std::set<std::string>& coordinates, std::vector<std::string>& inputs,
                 std::vector<std::string>& outputs) {
  inputs = file.labels(group + "/inputs");
  outputs = file.labels(group + "/outputs");
  label_set(file, group + "/inputs", inputs);
  const std::set<std::string> loaded = label_set(file, group + "/outputs", outputs);
  if (inputs.empty())
    file.refuse(group + "/inputs", "names no coordinate");
  for (const std::string& label : outputs)
    if (!coordinates.contains(label))
      file.refuse(group + "/outputs", in_quotes(label) + " is not in /coordinates");
  for (const std::string& label : inputs)
    if (!loaded.contains(label))
      file.refuse(group + "/inputs", in_quotes(label) + " is not among the outputs");
}

/// K(t) on a uniform grid from 0.
hydro::RadiationKernel read_kernel(const Input& file, const std::set<std::string>& coordinates) {
  const std::string group = "/radiation_kernel";
  hydro::RadiationKernel kernel;
  read_labels(file, group, coordinates, kernel.inputs, kernel.outputs);
  const std::vector<double> time = file.list(group + "/time");
  if (time.size() < 8)
    file.refuse(group + "/time", "must hold 8 times or more");
  kernel.step = time.back() / static_cast<double>(time.size() - 1);
  for (std::size_t k = 0; k < time.size(); ++k)
    if (!(std::abs(time[k] - static_cast<double>(k) * kernel.step) <= 1e-6 * kernel.step))
      file.refuse(group + "/time", "must be equally spaced from 0 s");
  const std::size_t rows = kernel.outputs.size(), columns = kernel.inputs.size();
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::vector<double> values = file.table(group + "/kernel", {time.size(), rows, columns});
  for (std::size_t k = 0; k < time.size(); ++k)
    kernel.values.emplace_back(Eigen::Map<const RowMajor>(values.data() + k * rows * columns,
                                                          static_cast<Eigen::Index>(rows),
                                                          static_cast<Eigen::Index>(columns)));
  kernel.added_mass_inf = file.matrix(group + "/added_mass_inf", rows, columns);
  return kernel;
}

hydro::MemoryFit read_fit(const Input& file, const std::string& name,
                          const std::set<std::string>& coordinates) {
  const std::string group = "/memory/" + name;
  hydro::MemoryFit fit;
  fit.name = name;
  read_labels(file, group, coordinates, fit.inputs, fit.outputs);
  fit.poles = file.complex_list(group + "/poles");
  const auto blocks = static_cast<std::size_t>(fit.poles.size());
  if (blocks == 0)
    file.refuse(group + "/poles", "is missing or empty");
  fit.input_matrix = file.complex_matrix(group + "/input_matrix", blocks, fit.inputs.size());
  fit.output_matrix = file.complex_matrix(group + "/output_matrix", fit.outputs.size(), blocks);
  fit.added_mass_inf =
      file.matrix(group + "/added_mass_inf", fit.outputs.size(), fit.inputs.size());
  check_poles(file, group, fit);
  for (const std::complex<double>& pole : fit.poles)
    fit.states += pole.imag() > 0.0 ? 2 : 1;
  if (file.has_attribute(group, "n_states") && file.number(group, "n_states") != fit.states)
    file.refuse(group, "n_states is " + number_text(file.number(group, "n_states")) +
                           ", the poles make " + std::to_string(fit.states));
  fit.passive = file.has_attribute(group, "passive") && file.number(group, "passive") != 0.0;
  return fit;
}

/// Frequencies, headings and Froude-Krylov plus diffraction; headings in ascending order.
void read_excitation(const Input& file, hydro::Database& database) {
  const std::vector<double> heading = file.list("/heading");
  const auto nw = static_cast<std::size_t>(database.omega.size()), nh = heading.size();
  const std::size_t n = database.coordinates.size();
  if (nh == 0)
    file.refuse("/heading", "is missing or empty");
  std::vector<std::size_t> order(nh);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return heading[a] < heading[b]; });
  const auto froude_krylov = file.complex_table("/excitation/froude_krylov", {nw, nh, n});
  const auto diffraction = file.complex_table("/excitation/diffraction", {nw, nh, n});
  database.heading.resize(static_cast<Eigen::Index>(nh));
  for (std::size_t h = 0; h < nh; ++h) {
    const auto row = static_cast<Eigen::Index>(h);
    database.heading[row] = heading[order[h]];
    if (h > 0 && !(database.heading[row] > database.heading[row - 1]))
      file.refuse("/heading", "a heading stands there twice");
    Eigen::MatrixXcd force(nw, n), part(nw, n);
    for (std::size_t w = 0; w < nw; ++w)
      for (std::size_t c = 0; c < n; ++c) {
        const std::size_t k = (w * nh + order[h]) * n + c;
        force(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(c)) =
            froude_krylov[k] + diffraction[k];
        part(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(c)) = froude_krylov[k];
      }
    database.excitation.push_back(force);
    database.froude_krylov.push_back(part);
  }
  const bool known = !file.has_attribute("/excitation", "split") ||
                     file.text("/excitation", "split") != "total only";
  const auto some = [](const Eigen::MatrixXcd& part) { return !part.isZero(0.0); };
  if (!known || std::none_of(database.froude_krylov.begin(), database.froude_krylov.end(), some))
    database.froude_krylov.clear();
}

std::vector<MatrixX> read_matrices(const Input& file, const std::string& dataset, std::size_t nw,
                                   std::size_t n) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::vector<double> values = file.table(dataset, {nw, n, n});
  const auto size = static_cast<Eigen::Index>(n);
  std::vector<MatrixX> out;
  for (std::size_t w = 0; w < nw; ++w)
    out.emplace_back(Eigen::Map<const RowMajor>(values.data() + w * n * n, size, size));
  return out;
}

/// One kind of loads of pairs of waves.
hydro::SecondOrderTable read_second_order(const Input& file, const std::string& kind,
                                          const std::set<std::string>& coordinates) {
  const std::string group = "/second_order/" + kind;
  if (!hydro::second_order_kind(kind))
    file.refuse(group, "expected mean, difference or sum");
  hydro::SecondOrderTable table;
  table.kind = kind;
  table.coordinates = file.labels(group + "/coordinates");
  table.method = file.labels(group + "/method");
  const auto vector = [&](const std::string& name) {
    const std::vector<double> list = file.list(group + "/" + name);
    return VectorX(Eigen::Map<const VectorX>(list.data(), static_cast<Eigen::Index>(list.size())));
  };
  table.omega = vector("omega");
  table.heading1 = vector("heading1");
  table.heading2 = vector("heading2");
  for (const std::string& label : label_set(file, group + "/coordinates", table.coordinates))
    if (!coordinates.contains(label))
      file.refuse(group + "/coordinates", in_quotes(label) + " is not in /coordinates");
  if (table.coordinates.empty() || table.method.size() != table.coordinates.size())
    file.refuse(group + "/method", "must name the method of each of the coordinates");
  if (table.omega.size() == 0 || !(table.omega[0] > 0.0) ||
      !std::is_sorted(table.omega.begin(), table.omega.end(), std::less_equal<>()))
    file.refuse(group + "/omega", "must be ascending frequencies > 0 rad/s");
  if (table.heading1.size() == 0 || table.heading1.size() != table.heading2.size())
    file.refuse(group + "/heading2", "must be as long as heading1, and not empty");
  const auto nw = static_cast<std::size_t>(table.omega.size());
  std::vector<std::size_t> shape(table.one_axis() ? 1 : 2, nw);
  shape.push_back(static_cast<std::size_t>(table.heading1.size()));
  shape.push_back(table.coordinates.size());
  table.values = file.complex_table(group + "/values", shape);
  for (const double truth : file.table(group + "/computed", shape))
    table.computed.push_back(truth != 0.0);
  if (file.has_attribute(group, "source"))
    table.source = file.text(group, "source");
  return table;
}

void read_frequencies(const Input& file, hydro::Database& database) {
  const std::vector<double> omega = file.list("/omega");
  database.omega = Eigen::Map<const VectorX>(omega.data(), static_cast<Eigen::Index>(omega.size()));
  if (omega.size() < 2 || !(omega.front() > 0.0) ||
      !std::is_sorted(omega.begin(), omega.end(), std::less_equal<>()))
    file.refuse("/omega", "must be two or more ascending frequencies > 0 rad/s");
}

} // namespace

hydro::Database read_hydro_file(const std::string& path, const HydroTables& tables) {
  const Input file(path);
  check_format(file);
  hydro::Database database;
  database.path = path;
  database.rho = file.number("/", "rho");
  database.gravity = file.number("/", "gravity");
  database.water_depth = file.number("/", "water_depth");
  require_positive(file, "rho", database.rho);
  require_positive(file, "gravity", database.gravity);
  require_positive(file, "water_depth", database.water_depth);
  database.coordinates = file.labels("/coordinates");
  const std::size_t n = database.coordinates.size();
  const std::set<std::string> coordinates = label_set(file, "/coordinates", database.coordinates);
  database.added_mass_inf = file.matrix("/added_mass_inf", n, n);
  database.bodies = read_bodies(file, database.coordinates);
  for (const std::string& name : file.members("/memory"))
    database.fits.push_back(read_fit(file, name, coordinates));
  if (tables.excitation || tables.radiation)
    read_frequencies(file, database);
  if (tables.excitation)
    read_excitation(file, database);
  if (tables.second_order)
    for (const std::string& kind : file.members("/second_order"))
      database.second_order.push_back(read_second_order(file, kind, coordinates));
  if (tables.kernel && file.has_object("/radiation_kernel"))
    database.kernel = read_kernel(file, coordinates);
  if (tables.radiation) {
    const auto nw = static_cast<std::size_t>(database.omega.size());
    database.added_mass = read_matrices(file, "/added_mass", nw, n);
    database.damping = read_matrices(file, "/radiation_damping", nw, n);
  }
  return database;
}

SharedHydroFile shared_hydro_file(const std::string& path, const HydroTables& tables) {
  struct Entry {
    HydroTables tables;
    std::string sha256;
    std::weak_ptr<const hydro::Database> database;
  };
  static std::mutex mutex;
  static std::map<std::string, Entry> entries;
  const std::lock_guard lock(mutex);
  std::string sha256;
  if (const auto found = entries.find(path); found != entries.end())
    if (auto held = found->second.database.lock(); held && found->second.tables == tables) {
      sha256 = sha256_of_file(path);
      if (found->second.sha256 == sha256)
        return {std::move(held), std::move(sha256)};
    }
  auto database = std::make_shared<const hydro::Database>(read_hydro_file(path, tables));
  if (sha256.empty())
    sha256 = sha256_of_file(path);
  entries[path] = {tables, sha256, database};
  return {std::move(database), std::move(sha256)};
}

} // namespace hydrodae::io
