#pragma once
/// `results.h5`, written as the run goes.

#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hydrodae/core/channel.h"

namespace hydrodae::io {

using Attribute = std::variant<double, std::int64_t, std::string>;
using Attributes = std::map<std::string, Attribute>;

/// One results file: dataset `time` and one chunked dataset a channel, each with unit, frame and
/// description as attributes. Rows are buffered and flushed so that a killed run stays readable.
class ResultsFile {
public:
  /// Creates (replaces) the file with root attributes `header` and status "running".
  /// Throws CaseError when the file cannot be written.
  ResultsFile(const std::string& path, const std::vector<Channel>& channels,
              const Attributes& header);
  ~ResultsFile(); ///< flushes and closes; status stays "running" when close was not called
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// Appends one sample; `values` holds all channels one after the other. No allocation.
  void append(double time, std::span<const double> values);

  /// Writes what is buffered, the status ("completed", "interrupted", "failed"), the message and
  /// the statistics (attributes of group `solver`), and closes the file.
  void close(const std::string& status, const std::string& message, const Attributes& statistics);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace hydrodae::io
