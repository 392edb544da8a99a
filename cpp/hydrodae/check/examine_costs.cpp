/// Cost of the elements of a scene.

#include <algorithm>
#include <cmath>
#include <ostream>

#include "hydrodae/accuracy/comparison.h"
#include "hydrodae/check/examine.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/results_file.h"
#include "hydrodae/run/controllers.h"

namespace hydrodae::check {

namespace {

using system::Regime;

/// Element of each unknown, and in `elements` all elements with their costs.
std::vector<int> owner_of_unknowns(const Regime& s, std::vector<ElementCost>& elements) {
  std::vector<int> owner(static_cast<std::size_t>(s.n), -1);
  const auto take = [&](Index i, Index ElementCost::* count) {
    owner[static_cast<std::size_t>(i)] = static_cast<int>(elements.size()) - 1;
    ++(elements.back().*count);
  };
  for (const system::JointData& j : s.joints) {
    if (j.hidden)
      continue;
    elements.push_back({"joint " + j.name});
    for (const system::RowData& row : j.rows)
      if (s.holds(row)) {
        take(s.lambda(row), &ElementCost::multipliers);
        take(s.mu(row), &ElementCost::multipliers);
      }
  }
  for (const system::CouplerData& c : s.couplers) {
    elements.push_back({"constraint " + c.name});
    if (!s.holds(c))
      continue;
    take(s.lambda(c), &ElementCost::multipliers);
    if (!c.velocity_level)
      take(s.mu(c), &ElementCost::multipliers);
  }
  for (const system::BodyData& b : s.bodies) {
    elements.push_back({"body " + b.name});
    for (int k = 0; k < b.n_position; ++k)
      take(b.q0 + k, &ElementCost::unknowns);
    for (int k = 0; k < b.n_active; ++k)
      take(b.u0 + k, &ElementCost::unknowns);
    if (s.sigma(b) >= 0)
      take(s.sigma(b), &ElementCost::unknowns);
  }
  for (const system::StateBlock& block : s.states) {
    elements.push_back({block.owner});
    for (std::size_t k = 0; k < block.unknowns.size(); ++k)
      take(block.first + static_cast<Index>(k), &ElementCost::unknowns);
  }
  return owner;
}

} // namespace

std::vector<ElementCost> element_costs(const Regime& s, const system::Pattern& pattern) {
  std::vector<ElementCost> elements;
  const std::vector<int> owner = owner_of_unknowns(s, elements);
  std::size_t joints = 0; // number of elements with multipliers
  while (joints < elements.size() && !elements[joints].name.starts_with("body "))
    ++joints;
  // elements of states follow
  const auto states = static_cast<int>(elements.size() - s.states.size());
  Index between = 0;
  for (Index column = 0; column < s.n; ++column)
    for (Index k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k) {
      const int a = owner[static_cast<std::size_t>(column)],
                b = owner[static_cast<std::size_t>(pattern.row[k])];
      const bool of_joint = std::min(a, b) < static_cast<int>(joints);
      if (of_joint || a == b)
        ++elements[static_cast<std::size_t>(std::min(a, b))].nonzeros;
      else if (std::max(a, b) >= states)
        ++elements[static_cast<std::size_t>(std::max(a, b))].nonzeros;
      else
        ++between;
    }
  if (between > 0)
    elements.push_back({"between bodies", 0, 0, between});
  return elements;
}

void write_sizes(std::ostream& out, const model::Scene& scene, const Regime& s, std::size_t width) {
  const double samples = 1.0 + std::floor(scene.solver.end_time / scene.output.step),
               row = 8.0 * static_cast<double>(width + 1);
  const auto megabytes = [](double bytes) { return rounded_text(bytes / 1e6, 3) + " MB"; };
  double memory = 2.0 * io::rows_per_chunk * row; // buffers here and in HDF5
  if (scene.solver.accuracy != "none") {
    const accuracy::Movers movers(s);
    const double spans = static_cast<double>(accuracy::Comparison::most_spans),
                 waiting = run::asks_outside(scene) ? samples : accuracy::Comparison::most_ahead;
    memory += std::min(samples, spans) * (8.0 + 32.0 * static_cast<double>(movers.size())) +
              std::min(samples, waiting) * 8.0 * static_cast<double>(movers.width());
  }
  out << "  results: " << number_text(samples) << " samples of " << width << " values, "
      << megabytes(samples * row) << "; samples take up to " << megabytes(memory) << " of memory\n";
}

} // namespace hydrodae::check
