/// Radiation by a fitted memory of exponentials.

#include <complex>

#include "hydrodae/build/radiation.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::build {

// Real form of the fit: a pole p = a + i b with Im > 0 becomes two states (Re z, Im z); blocks
// that nothing drives are left out.
std::vector<std::string> fill_exponential(const model::Scene& scene, system::System& s) {
  const hydro::MemoryFit* found = model::memory_fit(scene);
  if (!found) // nothing moves
    return fill_no_radiation(scene, s);
  const hydro::MemoryFit& fit = *found;
  system::HydroData& h = s.hydro;
  h.added_mass_all = cut(scene, h, fit.outputs, fit.inputs, fit.added_mass_inf);
  const std::vector<int> input = places(scene, h, fit.inputs);
  std::vector<int> column; // of `output_all`: block of the fit, twice for a pair
  for (int k = 0; k < fit.poles.size(); ++k) {
    const bool pair = fit.poles[k].imag() != 0.0;
    const int state = h.n_states;
    bool driven = false;
    for (int u = 0; u < h.n_moving; ++u) {
      if (input[static_cast<std::size_t>(u)] < 0)
        continue;
      const std::complex<double> b = fit.input_matrix(k, input[static_cast<std::size_t>(u)]);
      if (b.real() != 0.0)
        h.inputs.push_back({state, u, b.real()});
      if (pair && b.imag() != 0.0)
        h.inputs.push_back({state + 1, u, b.imag()});
      driven = driven || b != 0.0;
    }
    if (!driven)
      continue;
    h.blocks.push_back({state, fit.poles[k].real(), fit.poles[k].imag(), pair});
    h.n_states += pair ? 2 : 1;
    for (int n = 0; n < (pair ? 2 : 1); ++n)
      column.push_back(k);
  }
  const std::vector<int> row = all_places(scene, h, fit.outputs);
  h.output_all = MatrixX::Zero(std::ssize(row), h.n_states);
  for (const system::HydroData::Block& b : h.blocks) // Re(C z) = Re C Re z - Im C Im z
    for (Index r = 0; r < std::ssize(row); ++r) {
      if (row[static_cast<std::size_t>(r)] < 0)
        continue;
      const std::complex<double> C =
          fit.output_matrix(row[static_cast<std::size_t>(r)], column[b.state]);
      h.output_all(r, b.state) = C.real();
      if (b.pair)
        h.output_all(r, b.state + 1) = -C.imag();
    }
  return fit.outputs;
}

} // namespace hydrodae::build
