#include "hydrodae/io/hydro_file.h"

#include <algorithm>
#include <cmath>
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
    const std::string owner = label.substr(0, label.rfind('.'));
    const auto owns = [&](const hydro::DatabaseBody& body) { return body.name == owner; };
    if (std::none_of(bodies.begin(), bodies.end(), owns))
      file.refuse("/coordinates", in_quotes(label) + " belongs to no group of /bodies");
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

void check_labels(const Input& file, const std::string& group, const hydro::MemoryFit& fit,
                  const std::set<std::string>& coordinates) {
  label_set(file, group + "/inputs", fit.inputs);
  const std::set<std::string> outputs = label_set(file, group + "/outputs", fit.outputs);
  if (fit.inputs.empty())
    file.refuse(group + "/inputs", "names no coordinate");
  for (const std::string& label : fit.outputs)
    if (!coordinates.contains(label))
      file.refuse(group + "/outputs", in_quotes(label) + " is not in /coordinates");
  for (const std::string& label : fit.inputs)
    if (!outputs.contains(label))
      file.refuse(group + "/inputs", in_quotes(label) + " is not among the outputs");
}

hydro::MemoryFit read_fit(const Input& file, const std::string& name,
                          const std::set<std::string>& coordinates) {
  const std::string group = "/memory/" + name;
  hydro::MemoryFit fit;
  fit.name = name;
  fit.inputs = file.labels(group + "/inputs");
  fit.outputs = file.labels(group + "/outputs");
  check_labels(file, group, fit, coordinates);
  fit.poles = file.complex_list(group + "/poles");
  const auto blocks = static_cast<std::size_t>(fit.poles.size());
  if (blocks == 0)
    file.refuse(group + "/poles", "there is none");
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

} // namespace

hydro::Database read_hydro_file(const std::string& path) {
  const Input file(path);
  check_format(file);
  hydro::Database database;
  database.path = path;
  database.sha256 = sha256_of_file(path);
  database.rho = file.number("/", "rho");
  database.gravity = file.number("/", "gravity");
  database.water_depth = file.number("/", "water_depth");
  require_positive(file, "rho", database.rho);
  require_positive(file, "gravity", database.gravity);
  require_positive(file, "water_depth", database.water_depth);
  database.coordinates = file.labels("/coordinates");
  const std::size_t n = database.coordinates.size();
  const std::set<std::string> coordinates = label_set(file, "/coordinates", database.coordinates);
  database.bodies = read_bodies(file, database.coordinates);
  database.added_mass_inf = file.matrix("/added_mass_inf", n, n);
  for (const std::string& name : file.members("/memory"))
    database.fits.push_back(read_fit(file, name, coordinates));
  return database;
}

} // namespace hydrodae::io
