#pragma once
/// Contents of a results file besides the recorder's rows: its attributes, and the impacts on
/// stops.

#include <string>
#include <vector>

#include "hydrodae/io/results_file.h"
#include "hydrodae/run/simulation.h"
#include "hydrodae/simulation.h"

namespace hydrodae {

/// Text "a\nb\n".
std::string lines_of(const std::vector<std::string>& lines);

/// Attributes of the file known at the start.
io::Attributes header(const model::Scene& scene, const std::vector<std::string>& notes);

/// Attributes known at the end.
io::Attributes attributes(const RunStatistics& statistics, const model::Scene& scene,
                          const run::Simulation& done);

/// Attributes that follow from the statistics alone, such as counts, times and mean powers.
io::Attributes attributes(const RunStatistics& statistics);

/// Writes the methods of the steps with their start and reason: one line each in `methods`,
/// `method_from` [s] and `method_reason`; the last one as `method_in_use`.
void write_methods(const run::MethodChoice& choice, io::Attributes& out);

/// Writes the estimated error of each body and line over time.
void write_accuracy(const accuracy::Estimate& estimate, io::ResultsFile& file);

/// Writes the impacts on stops.
void write_impacts(const run::Simulation& simulation, io::ResultsFile& file);

} // namespace hydrodae
