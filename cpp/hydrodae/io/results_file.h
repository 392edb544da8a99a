#pragma once
/// `results.h5`, written as the run goes.

#include <functional>
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

/// Rows of a chunk of a dataset, kept until written
inline constexpr std::size_t rows_per_chunk = 512;

/// Called before every write to the disk: tests look at the file as a killed process leaves it.
using WriteObserver = std::function<void()>;

/// One results file: dataset `time` and one chunked dataset a channel, each with unit, frame and
/// description as attributes. It is written as `X.partial.h5` (see output_place.h), which a killed
/// process leaves readable up to half a second before its end; `close` gives it its name.
class ResultsFile {
public:
  /// Creates the partial file with root attributes `header` and status "running". Throws CaseError
  /// when it cannot be written, another run writes it, or `path` holds no results file.
  ResultsFile(const std::string& path, const std::vector<Channel>& channels,
              const Attributes& header, WriteObserver observer = {});
  ~ResultsFile(); ///< without close, the partial file keeps its samples and the status "running"
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// Appends one sample; `values` holds all channels one after the other. No allocation.
  /// Throws SolverError when the file cannot be written any more (a full disk).
  void append(double time, std::span<const double> values);

  /// Writes all samples to disk.
  void flush();

  /// Writes samples that have waited for half a second: to be called where samples are rare.
  void flush_if_due();

  /// Adds a table of rows of `width` numbers that are known at the end only, with attributes; to be
  /// called before `close`. `close` reports a failure to write.
  void write_table(const std::string& path, int width, std::span<const double> values,
                   const Attributes& attributes);

  /// Writes what is buffered, the status ("completed", "interrupted", "failed"), the message and
  /// the statistics (attributes of group `solver`), and gives the file its final name.
  /// Where that fails, the status becomes "failed", what was written before stays, and SolverError
  /// is thrown unless `append` has thrown it. Does nothing the second time.
  void close(const std::string& status, const std::string& message, const Attributes& statistics);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace hydrodae::io
