#include "hydrodae/io/results_file.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "hydrodae/io/dimension_scales.h"
#include "hydrodae/io/hdf5.h"

namespace hydrodae::io {
namespace {

using hdf5::checked;
using hdf5::Handle;
using Clock = std::chrono::steady_clock;

constexpr std::size_t rows_per_flush = 512;
constexpr hsize_t rows_per_chunk = 512;
constexpr Clock::duration longest_wait = std::chrono::seconds(2);

void write_attribute(hid_t object, const std::string& name, const Attribute& value,
                     const std::string& what) {
  const bool is_text = std::holds_alternative<std::string>(value);
  const bool is_real = std::holds_alternative<double>(value);
  const Handle text = hdf5::text_type();
  const hid_t type =
      is_text ? static_cast<hid_t>(text) : (is_real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64);
  if (checked(H5Aexists(object, name.c_str()), what) > 0)
    checked(H5Adelete(object, name.c_str()), what);
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute = checked(
      H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  const char* characters = is_text ? std::get<std::string>(value).c_str() : nullptr;
  const void* data = is_text   ? static_cast<const void*>(&characters)
                     : is_real ? static_cast<const void*>(&std::get<double>(value))
                               : static_cast<const void*>(&std::get<std::int64_t>(value));
  checked(H5Awrite(attribute, type, data), what);
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

/// A dataset that grows by rows.
struct Column {
  Handle dataset;
  std::size_t offset = 0; ///< of its first value in a row of the buffer
  std::size_t width = 1;
};

} // namespace

struct ResultsFile::Impl {
  std::string path;
  Handle file;
  std::vector<Column> columns; ///< time first
  std::size_t row_size = 0;    ///< values in a row of the buffer
  std::vector<double> buffer;  ///< rows that are not in the file yet
  std::vector<double> scratch; ///< one column of them
  std::size_t buffered = 0;    ///< rows
  std::size_t written = 0;     ///< rows
  Clock::time_point last_flush = Clock::now();

  std::string what() const { return path + ": cannot be written"; }
  void create(const Attributes& header);
  void add_column(const Channel& channel);
  void write_column(const Column& column);
  void flush();
};

void ResultsFile::Impl::create(const Attributes& header) {
  file =
      checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, what());
  write_attribute(file, "format", std::string("hydrodae-results"), what());
  write_attribute(file, "format_version", std::int64_t{1}, what());
  for (const auto& [name, value] : header)
    write_attribute(file, name, value, what());
  write_attribute(file, "status", std::string("running"), what());
  hdf5::write_labels(file, "component", {"x", "y", "z"}, what());
  hdf5::write_labels(file, "quaternion", {"w", "x", "y", "z"}, what());
}

void ResultsFile::Impl::add_column(const Channel& channel) {
  const bool scalar = channel.width == 1;
  const int rank = scalar ? 1 : 2;
  const auto width = static_cast<hsize_t>(channel.width);
  const hsize_t empty[2] = {0, width}, unlimited[2] = {H5S_UNLIMITED, width},
                chunk[2] = {rows_per_chunk, width};
  const Handle space = checked(H5Screate_simple(rank, empty, unlimited), H5Sclose, what());
  const Handle layout = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what());
  checked(H5Pset_chunk(layout, rank, chunk), what());
  const Handle links = checked(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what());
  checked(H5Pset_create_intermediate_group(links, 1), what());

  Column column;
  column.dataset = checked(
      H5Dcreate2(file, channel.path.c_str(), H5T_NATIVE_DOUBLE, space, links, layout, H5P_DEFAULT),
      H5Dclose, what() + " (channel " + channel.path + ")");
  column.offset = row_size;
  column.width = static_cast<std::size_t>(channel.width);
  write_attribute(column.dataset, "unit", channel.unit, what());
  write_attribute(column.dataset, "frame", channel.frame, what());
  write_attribute(column.dataset, "description", channel.description, what());
  for (const auto& [name, value] : channel.vectors)
    write_vector(column.dataset, name, value, what());
  if (columns.empty()) // the time
    hdf5::make_scale(column.dataset, channel.path, what());
  else if (scalar)
    hdf5::attach_scales(file, column.dataset, {"time"}, what());
  else
    hdf5::attach_scales(file, column.dataset,
                        {"time", channel.width == 4 ? "quaternion" : "component"}, what());
  row_size += column.width;
  columns.push_back(std::move(column));
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

void ResultsFile::Impl::flush() {
  if (buffered > 0) {
    for (const Column& column : columns)
      write_column(column);
    written += buffered;
    buffered = 0;
  }
  checked(H5Fflush(file, H5F_SCOPE_LOCAL), what());
  last_flush = Clock::now();
}

ResultsFile::ResultsFile(const std::string& path, const std::vector<Channel>& channels,
                         const Attributes& header)
    : impl_(std::make_unique<Impl>()) {
  const hdf5::Quiet quiet;
  impl_->path = path;
  impl_->create(header);
  impl_->add_column({"time", 1, "s", "-", "Time."});
  std::size_t widest = 1;
  for (const Channel& channel : channels) {
    impl_->add_column(channel);
    widest = std::max(widest, static_cast<std::size_t>(channel.width));
  }
  impl_->buffer.resize(rows_per_flush * impl_->row_size);
  impl_->scratch.resize(rows_per_flush * widest);
  impl_->flush();
}

ResultsFile::~ResultsFile() {
  const hdf5::Quiet quiet;
  try {
    if (impl_->file >= 0)
      impl_->flush();
  } catch (const Error&) { // a destructor has nobody to tell; the status stays "running"
  }
}

void ResultsFile::append(double time, std::span<const double> values) {
  Impl& f = *impl_;
  assert(values.size() + 1 == f.row_size);
  if (f.buffered == rows_per_flush || Clock::now() - f.last_flush > longest_wait) {
    const hdf5::Quiet quiet;
    f.flush();
  }
  double* row = f.buffer.data() + f.buffered * f.row_size;
  *row = time;
  std::copy(values.begin(), values.end(), row + 1);
  ++f.buffered;
}

void ResultsFile::close(const std::string& status, const std::string& message,
                        const Attributes& statistics) {
  const hdf5::Quiet quiet;
  Impl& f = *impl_;
  f.flush();
  {
    const bool exists = checked(H5Lexists(f.file, "solver", H5P_DEFAULT), f.what()) > 0;
    const Handle group =
        checked(exists ? H5Gopen2(f.file, "solver", H5P_DEFAULT)
                       : H5Gcreate2(f.file, "solver", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                H5Gclose, f.what());
    for (const auto& [name, value] : statistics)
      write_attribute(group, name, value, f.what());
  }
  write_attribute(f.file, "status", status, f.what());
  write_attribute(f.file, "message", message, f.what());
  f.columns.clear();
  checked(f.file.reset(), f.what());
}

} // namespace hydrodae::io
