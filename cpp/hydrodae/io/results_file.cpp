#include "hydrodae/io/results_file.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "hydrodae/core/text.h"
#include "hydrodae/io/dimension_scales.h"
#include "hydrodae/io/hdf5.h"
#include "hydrodae/io/ordered_file.h"
#include "hydrodae/io/output_place.h"

namespace hydrodae::io {
namespace {

using hdf5::checked;
using hdf5::Handle;
using Clock = std::chrono::steady_clock;

constexpr Clock::duration longest_wait = std::chrono::milliseconds(500);

} // namespace

/// Writes attributes of one value each.
class AttributeWriter {
public:
  void write(hid_t object, const std::string& name, const Attribute& value,
             const std::string& what) const {
    const bool is_text = std::holds_alternative<std::string>(value);
    const bool is_real = std::holds_alternative<double>(value);
    const hid_t type =
        is_text ? static_cast<hid_t>(text_) : (is_real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64);
    // Overwritten rather than made again: that changes one block of the file.
    const bool exists = checked(H5Aexists(object, name.c_str()), what) > 0;
    const Handle attribute =
        checked(exists ? H5Aopen(object, name.c_str(), H5P_DEFAULT)
                       : H5Acreate2(object, name.c_str(), type, one_, H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose, what);
    const char* characters = is_text ? std::get<std::string>(value).c_str() : nullptr;
    const void* data = is_text   ? static_cast<const void*>(&characters)
                       : is_real ? static_cast<const void*>(&std::get<double>(value))
                                 : static_cast<const void*>(&std::get<std::int64_t>(value));
    checked(H5Awrite(attribute, type, data), what);
  }

private:
  Handle text_ = hdf5::text_type();
  Handle one_ = checked(H5Screate(H5S_SCALAR), H5Sclose, "HDF5 attribute");
};

namespace {

/// Two messages below each other; either may be empty.
std::string lines(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "\n  ") + second;
}

void write_vector(hid_t object, const std::string& name, const Vector3& value,
                  const std::string& what) {
  const hsize_t size = 3;
  const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, what);
  const Handle attribute =
      checked(H5Acreate2(object, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose, what);
  checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, value.data()), what);
}

} // namespace

struct ResultsFile::Impl {
  /// A dataset that grows by rows.
  struct Column {
    Handle dataset;
    std::size_t offset = 0; ///< offset of its first value in a row of the buffer
    std::size_t width = 1;
  };
  /// Common data of all columns of one width.
  struct Kind {
    int width;
    Handle space, layout, cache;
    hdf5::ScaleList scales;
  };

  OutputPlace place;
  OrderedFile disk;
  Handle file;
  AttributeWriter attributes;
  Handle links;            ///< properties of links: the groups above are made with them
  std::vector<Kind> kinds; ///< kinds of columns after the time
  std::string last_group;  ///< group of the last column; empty: the root
  Handle group;
  std::vector<Column> columns; ///< time first
  std::size_t row_size = 0;    ///< values in a row of the buffer
  std::vector<double> buffer;  ///< rows not yet passed to HDF5, at most one chunk
  std::vector<double> scratch; ///< one column of these rows
  std::size_t buffered = 0;    ///< number of buffered rows
  std::size_t written = 0;     ///< number of rows passed to HDF5
  std::size_t committed = 0;   ///< number of rows on disk
  double last_time = 0.0;      ///< time of the last row [s]
  double committed_time = 0.0; ///< time of the last row on disk [s]
  bool waiting = false;        ///< true: some rows are not on disk
  bool closed = false;
  Clock::time_point last_commit = Clock::now();

  Impl(const std::string& path, WriteObserver observer) : place(path), disk(std::move(observer)) {}

  std::string what() const { return place.path() + ": cannot be written"; }
  void create(const Attributes& header);
  Kind make_kind(int width, const std::vector<std::string>& scales) const;
  Kind& kind_of(const Channel& channel);
  Column& make_column(const Channel& channel, const Kind& kind);
  void add_time();
  void add_column(const Channel& channel);
  void write_column(const Column& column);
  void write_rows();
  void commit();
  void write_end(const std::string& status, const std::string& message,
                 const Attributes& statistics);
  void salvage(const std::string& message, const Attributes& statistics);
  void require_written() const;
};

void ResultsFile::Impl::create(const Attributes& header) {
  const Handle access = disk.access_properties();
  file = checked(H5Fcreate(place.partial().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose,
                 what());
  attributes.write(file, "format", std::string("hydrodae-results"), what());
  attributes.write(file, "format_version", std::int64_t{1}, what());
  for (const auto& [name, value] : header)
    attributes.write(file, name, value, what());
  attributes.write(file, "status", std::string("running"), what());
  attributes.write(file, "message", std::string(), what());
  links = checked(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what());
  checked(H5Pset_create_intermediate_group(links, 1), what());
  hdf5::write_labels(file, "component", {"x", "y", "z"}, what());
  hdf5::write_labels(file, "quaternion", {"w", "x", "y", "z"}, what());
}

ResultsFile::Impl::Kind ResultsFile::Impl::make_kind(int width,
                                                     const std::vector<std::string>& scales) const {
  const int rank = width == 1 ? 1 : 2;
  const auto in_row = static_cast<hsize_t>(width);
  const hsize_t empty[2] = {0, in_row}, unlimited[2] = {H5S_UNLIMITED, in_row},
                chunk[2] = {rows_per_chunk, in_row};
  Kind kind{width,
            checked(H5Screate_simple(rank, empty, unlimited), H5Sclose, what()),
            checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what()),
            checked(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, what()),
            {file, scales, what()}};
  checked(H5Pset_chunk(kind.layout, rank, chunk), what());
  // Only the last chunk changes: HDF5's own cache holds a megabyte a dataset.
  checked(H5Pset_chunk_cache(kind.cache, 3, rows_per_chunk * in_row * sizeof(double), 1.0), what());
  return kind;
}

ResultsFile::Impl::Kind& ResultsFile::Impl::kind_of(const Channel& channel) {
  const int width = channel.width;
  const auto known =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.width == width; });
  if (known != kinds.end())
    return *known;
  std::vector<std::string> scales = {"time"};
  if (width > 1)
    scales.push_back(width == 4 ? "quaternion" : "component");
  return kinds.emplace_back(make_kind(width, scales));
}

ResultsFile::Impl::Column& ResultsFile::Impl::make_column(const Channel& channel,
                                                          const Kind& kind) {
  const std::size_t slash = channel.path.rfind('/');
  const std::string above = slash == std::string::npos ? "" : channel.path.substr(0, slash);
  const bool here = !above.empty() && above == last_group;
  Column column;
  column.dataset =
      checked(H5Dcreate2(here ? static_cast<hid_t>(group) : static_cast<hid_t>(file),
                         here ? channel.path.c_str() + slash + 1 : channel.path.c_str(),
                         H5T_NATIVE_DOUBLE, kind.space, links, kind.layout, kind.cache),
              H5Dclose, what() + " (channel " + channel.path + ")");
  if (!here && !above.empty()) { // the next is likely to be there, too
    group = checked(H5Gopen2(file, above.c_str(), H5P_DEFAULT), H5Gclose, what());
    last_group = above;
  }
  column.offset = row_size;
  column.width = static_cast<std::size_t>(channel.width);
  attributes.write(column.dataset, "unit", channel.unit, what());
  attributes.write(column.dataset, "frame", channel.frame, what());
  attributes.write(column.dataset, "description", channel.description, what());
  for (const auto& [name, value] : channel.vectors)
    write_vector(column.dataset, name, value, what());
  row_size += column.width;
  return columns.emplace_back(std::move(column));
}

void ResultsFile::Impl::add_time() {
  const Column& time = make_column({"time", 1, "s", "-", "Time."}, make_kind(1, {}));
  hdf5::make_scale(time.dataset, "time", what());
}

void ResultsFile::Impl::add_column(const Channel& channel) {
  Kind& kind = kind_of(channel);
  kind.scales.attach(make_column(channel, kind).dataset, what());
}

void ResultsFile::Impl::write_column(const Column& column) {
  for (std::size_t row = 0; row < buffered; ++row)
    std::copy_n(buffer.data() + row * row_size + column.offset, column.width,
                scratch.data() + row * column.width);
  const hsize_t start[2] = {written, 0}, count[2] = {buffered, column.width},
                size[2] = {written + buffered, column.width};
  checked(H5Dset_extent(column.dataset, size), what());
  const Handle target = checked(H5Dget_space(column.dataset), H5Sclose, what());
  checked(H5Sselect_hyperslab(target, H5S_SELECT_SET, start, nullptr, count, nullptr), what());
  const Handle source =
      checked(H5Screate_simple(column.width == 1 ? 1 : 2, count, nullptr), H5Sclose, what());
  checked(H5Dwrite(column.dataset, H5T_NATIVE_DOUBLE, source, target, H5P_DEFAULT, scratch.data()),
          what());
}

void ResultsFile::Impl::write_rows() {
  if (buffered > 0)
    for (const Column& column : columns)
      write_column(column);
  written += buffered;
  buffered = 0;
}

/// Writes all rows to disk.
void ResultsFile::Impl::commit() {
  write_rows();
  checked(H5Fflush(file, H5F_SCOPE_LOCAL), what());
  disk.commit();
  require_written();
  committed = written;
  committed_time = last_time;
  waiting = false;
  last_commit = Clock::now();
}

void ResultsFile::Impl::require_written() const {
  if (disk.failure().empty())
    return;
  if (written == 0)
    throw CaseError(what() + ": " + disk.failure());
  throw SolverError(
      last_time,
      {Reason::output,
       what() + ": " + disk.failure() + "; it keeps " +
           (committed == 0 ? "no sample"
                           : "the samples up to t = " + number_text(committed_time) + " s")});
}

void ResultsFile::Impl::write_end(const std::string& status, const std::string& message,
                                  const Attributes& statistics) {
  {
    const bool exists = checked(H5Lexists(file, "solver", H5P_DEFAULT), what()) > 0;
    const Handle solver =
        checked(exists ? H5Gopen2(file, "solver", H5P_DEFAULT)
                       : H5Gcreate2(file, "solver", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                H5Gclose, what());
    for (const auto& [name, value] : statistics)
      attributes.write(solver, name, value, what());
  }
  attributes.write(file, "status", status, what());
  attributes.write(file, "message", message, what());
  columns.clear();
  checked(file.reset(), what());
  disk.commit();
}

/// After a failure to write: the end of the run into what is on disk, in the space that the
/// samples leave that were lost. Where even that fails, the file stays as it is.
void ResultsFile::Impl::salvage(const std::string& message, const Attributes& statistics) {
  columns.clear();
  file.reset();
  disk.recover();
  try {
    const Handle access = disk.access_properties();
    file = checked(H5Fopen(place.partial().c_str(), H5F_ACC_RDWR, access), H5Fclose, what());
    write_end("failed", message, statistics);
  } catch (const CaseError&) {
    file.reset();
  }
}

ResultsFile::ResultsFile(const std::string& path, const std::vector<Channel>& channels,
                         const Attributes& header, WriteObserver observer)
    : impl_(std::make_unique<Impl>(path, std::move(observer))) {
  const hdf5::Quiet quiet;
  Impl& f = *impl_;
  f.create(header); // in memory, so that what is on disk is never less than a file
  f.add_time();
  std::size_t widest = 1;
  for (const Channel& channel : channels) {
    f.add_column(channel);
    widest = std::max(widest, static_cast<std::size_t>(channel.width));
  }
  f.group.reset();
  f.buffer.resize(rows_per_chunk * f.row_size);
  f.scratch.resize(rows_per_chunk * widest);
  checked(H5Fflush(f.file, H5F_SCOPE_LOCAL), f.what());
  f.disk.attach(f.place.open());
  try {
    f.commit();
  } catch (const Error&) {
    f.place.discard();
    throw;
  }
}

ResultsFile::~ResultsFile() {
  const hdf5::Quiet quiet;
  Impl& f = *impl_;
  if (f.closed)
    return;
  try {
    f.commit();
    f.columns.clear();
    f.file.reset();
    f.disk.commit();
  } catch (const Error&) { // a destructor must not throw; the status stays "running"
  }
}

void ResultsFile::append(double time, std::span<const double> values) {
  Impl& f = *impl_;
  assert(values.size() + 1 == f.row_size);
  double* row = f.buffer.data() + f.buffered * f.row_size;
  *row = time;
  std::copy(values.begin(), values.end(), row + 1);
  ++f.buffered;
  f.last_time = time;
  f.waiting = true;
  if ((f.written + f.buffered) % rows_per_chunk == 0)
    flush();
  else
    flush_if_due();
}

void ResultsFile::flush() {
  const hdf5::Quiet quiet;
  impl_->commit();
}

void ResultsFile::flush_if_due() {
  if (impl_->waiting && Clock::now() - impl_->last_commit >= longest_wait)
    flush();
}

void ResultsFile::write_table(const std::string& path, int width, std::span<const double> values,
                              const Attributes& attributes) {
  const hdf5::Quiet quiet;
  Impl& f = *impl_;
  if (f.closed || !f.disk.failure().empty())
    return;
  const auto columns = static_cast<hsize_t>(width);
  const hsize_t size[2] = {values.size() / columns, columns};
  const Handle space = checked(H5Screate_simple(2, size, nullptr), H5Sclose, f.what());
  const Handle table = checked(
      H5Dcreate2(f.file, path.c_str(), H5T_NATIVE_DOUBLE, space, f.links, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose, f.what());
  checked(H5Dwrite(table, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          f.what());
  for (const auto& [name, value] : attributes)
    f.attributes.write(table, name, value, f.what());
}

void ResultsFile::close(const std::string& status, const std::string& message,
                        const Attributes& statistics) {
  const hdf5::Quiet quiet;
  Impl& f = *impl_;
  if (std::exchange(f.closed, true))
    return;
  std::string failure; // not reported yet
  if (f.disk.failure().empty()) {
    try {
      f.commit();
      f.write_end(status, message, statistics);
      f.require_written();
    } catch (const Error& error) {
      failure = error.what();
    }
  }
  if (!failure.empty() || !f.disk.failure().empty())
    f.salvage(lines(message, failure), statistics);
  if (const std::string why = f.place.finish(); !why.empty())
    failure = lines(failure, why + "; the results are in " + f.place.partial());
  if (!failure.empty())
    throw SolverError(f.last_time,
                      {Reason::output, failure, "", {}, "", message.empty() ? "" : "\n" + message});
}

} // namespace hydrodae::io
