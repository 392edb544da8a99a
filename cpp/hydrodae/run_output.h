#pragma once
/// What a run writes beside the recorder's rows: the attributes of its file, the impacts on stops.

#include <string>
#include <vector>

#include "hydrodae/io/results_file.h"
#include "hydrodae/simulation.h"
#include "hydrodae/solve/switching.h"

namespace hydrodae {

/// "a\nb\n"
std::string lines_of(const std::vector<std::string>& lines);

/// Attributes of the file that are known at the start.
io::Attributes header(const model::Scene& scene, const std::vector<std::string>& notes);

/// Those that are known at the end.
io::Attributes attributes(const RunStatistics& statistics, const model::Scene& scene,
                          double balance_error);

/// What the stops of a scene have taken: columns of sums, and a table of impacts for each.
class ImpactOutput {
public:
  explicit ImpactOutput(const system::System& system);

  std::vector<Channel> channels() const;
  std::size_t width() const { return 2 * stops_.size(); }

  /// Sums so far, in the order of the channels; `at` is of width().
  void fill(const solve::Switching* switching, double* at) const;
  void write(const solve::Switching* switching, io::ResultsFile& file) const;

private:
  struct Stop {
    std::size_t index; ///< among the switches
    std::string name;
    bool angle;
  };
  std::vector<Stop> stops_;
};

} // namespace hydrodae
