#include "hydrodae/water/radiation_exponential.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>

namespace hydrodae::water {

// Real form of the fit: a pole p = a + i b with Im > 0 becomes two states (Re z, Im z); blocks
// that nothing drives are left out.
std::vector<std::string> ExponentialRadiation::read(const RadiationSource& from, const Keys&,
                                                    AddedMass& added) {
  const WetBodies& wet = from.wet;
  output_all = MatrixX::Zero(6 * std::ssize(wet.bodies), 0);
  output = MatrixX::Zero(wet.n_moving, 0);
  if (!from.fit)
    return RadiationLaw::read(from, {}, added);
  const hydro::MemoryFit& fit = *from.fit;
  added.all = from.cut(fit.outputs, fit.inputs, fit.added_mass_inf);
  const std::vector<int> column_of = from.places(fit.inputs);
  std::vector<int> column; // of `output_all`: block of the fit, twice for a pair
  for (int k = 0; k < fit.poles.size(); ++k) {
    const bool pair = fit.poles[k].imag() != 0.0;
    const int state = static_cast<int>(column.size());
    bool driven = false;
    for (int u = 0; u < wet.n_moving; ++u) {
      const int place = column_of[static_cast<std::size_t>(u)];
      if (place < 0)
        continue;
      const std::complex<double> b = fit.input_matrix(k, place);
      if (b.real() != 0.0)
        inputs.push_back({state, u, b.real()});
      if (pair && b.imag() != 0.0)
        inputs.push_back({state + 1, u, b.imag()});
      driven = driven || b != 0.0;
    }
    if (!driven)
      continue;
    blocks.push_back({state, fit.poles[k].real(), fit.poles[k].imag(), pair});
    column.insert(column.end(), pair ? 2 : 1, k);
  }
  const std::vector<int> row = from.all_places(fit.outputs);
  output_all = MatrixX::Zero(std::ssize(row), std::ssize(column));
  for (const Block& b : blocks) // Re(C z) = Re C Re z - Im C Im z
    for (Index r = 0; r < std::ssize(row); ++r) {
      const int place = row[static_cast<std::size_t>(r)];
      if (place < 0)
        continue;
      const std::complex<double> C =
          fit.output_matrix(place, column[static_cast<std::size_t>(b.state)]);
      output_all(r, b.state) = C.real();
      if (b.pair)
        output_all(r, b.state + 1) = -C.imag();
    }
  output = wet.moving_rows(output_all);
  weight_of_state.assign(column.size(), -1);
  return fit.outputs;
}

void ExponentialRadiation::append(const ExponentialRadiation& from, int weight) {
  const int first = n_states();
  for (Block block : from.blocks) {
    block.state += first;
    blocks.push_back(block);
  }
  for (Input in : from.inputs) {
    in.state += first;
    inputs.push_back(in);
  }
  const auto join = [](MatrixX& to, const MatrixX& more) {
    const Index columns = to.cols();
    to.conservativeResize(more.rows(), columns + more.cols());
    to.rightCols(more.cols()) = more;
  };
  join(output, from.output);
  join(output_all, from.output_all);
  weight_of_state.resize(static_cast<std::size_t>(n_states()), weight);
  blended = blended || weight >= 0;
}

void ExponentialRadiation::link(const WetBodies& wet) {
  std::vector<BlockMatrix::Entry> entries;
  for (const Input& in : inputs)
    entries.push_back({in.state, in.coordinate, in.value});
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return std::tie(a.column, a.row) < std::tie(b.column, b.row);
  });
  input = BlockMatrix(entries);
  product = BlockMatrix(output);
  product_all = BlockMatrix(output_all);
  links.assign(wet.bodies.size(), {});
  component.clear();
  for (const WetBodies::Coordinate& k : wet.coordinates)
    component.push_back(k.component);
  const auto of = [&](Index u) -> Links& {
    return links[static_cast<std::size_t>(wet.coordinates[static_cast<std::size_t>(u)].hydro_body)];
  };
  for (Index z = 0; z < output.cols(); ++z)
    for (Index u = 0; u < output.rows(); ++u)
      if (output(u, z) != 0.0)
        if (std::vector<int>& states = of(u).states; states.empty() || states.back() != z)
          states.push_back(static_cast<int>(z));
  for (std::size_t k = 0; k < inputs.size(); ++k)
    of(inputs[k].coordinate).inputs.push_back(static_cast<int>(k));
}

MatrixX ExponentialRadiation::input_matrix() const {
  MatrixX out = MatrixX::Zero(output.cols(), output.rows());
  for (const Input& in : inputs)
    out(in.state, in.coordinate) = in.value;
  return out;
}

// State z' = p z + B U: its size is that of B U / |p|.
std::vector<element::Unknown> ExponentialRadiation::unknowns(const VectorX& velocities) const {
  VectorX drive = VectorX::Zero(n_states());
  for (const Input& in : inputs)
    drive[in.state] += std::abs(in.value) * velocities[in.coordinate];
  std::vector<element::Unknown> out;
  for (const Block& b : blocks) {
    const double both = b.pair ? drive[b.state] + drive[b.state + 1] : drive[b.state];
    for (int k = 0; k < (b.pair ? 2 : 1); ++k)
      out.push_back({"state " + std::to_string(b.state + k), "", both / std::hypot(b.a, b.b), 0.0,
                     both, false});
  }
  return out;
}

void ExponentialRadiation::add_by_pose(const WaterMotion<double>& m, std::size_t i,
                                       Vector6& force) const {
  const HydroBody& hb = m.wet.bodies[i];
  for (const int z : links[i].states) {
    const int weight = weight_of_state[static_cast<std::size_t>(z)];
    if (weight < 0)
      continue;
    for (int c = 0; c < 6; ++c)
      if (hb.moving[c] >= 0)
        force[c] += output(hb.moving[c], z) * m.slopes[weight] * m.z[z];
  }
}

} // namespace hydrodae::water
