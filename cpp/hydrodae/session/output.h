#pragma once
/// What a run writes beside the recorder's rows: the attributes of its file, the impacts on stops.

#include <string>
#include <vector>

#include "hydrodae/io/results_file.h"
#include "hydrodae/run/simulation.h"
#include "hydrodae/simulation.h"

namespace hydrodae {

/// "a\nb\n"
std::string lines_of(const std::vector<std::string>& lines);

/// Attributes of the file that are known at the start.
io::Attributes header(const model::Scene& scene, const std::vector<std::string>& notes);

/// Those that are known at the end.
io::Attributes attributes(const RunStatistics& statistics, const model::Scene& scene,
                          const run::Simulation& done);

/// Counts, times and mean powers among them, as far as they follow from the statistics alone.
io::Attributes attributes(const RunStatistics& statistics);

/// Which methods made the steps from when on, and why: a line each of `methods`, `method_from` [s]
/// and `method_reason`; the last of them as `method_in_use`.
void write_methods(const run::MethodChoice& choice, io::Attributes& out);

/// Estimated error of each body and line over time.
void write_accuracy(const accuracy::Estimate& estimate, io::ResultsFile& file);

/// What the stops have taken, impact by impact.
void write_impacts(const run::Simulation& simulation, io::ResultsFile& file);

} // namespace hydrodae
