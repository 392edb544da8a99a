#pragma once
/// Rows of a results file that was cut off, for the run that goes on.

#include "hydrodae/io/results_file.h"

namespace hydrodae::io {

/// The first rows of the results of a run that ended early: in X.partial.h5 where it was killed,
/// in X.h5 where it was stopped.
class EarlierRows {
public:
  /// Finds the file and, where a new X.partial.h5 would overwrite it, renames it to X.resumed.h5.
  /// Throws CaseError unless there are `count` rows of these channels, the last at `time` [s], or
  /// when a run writes there now.
  EarlierRows(const std::string& path, const std::vector<Channel>& channels, std::size_t count,
              double time);

  /// Appends the rows to another file of the same channels.
  void copy(ResultsFile& to) const;

  /// Removes the renamed file, after the copy.
  void drop() const;

private:
  std::string aside_, found_;
  const std::vector<Channel>& channels_;
  std::size_t count_;
};

} // namespace hydrodae::io
