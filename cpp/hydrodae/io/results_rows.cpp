#include "hydrodae/io/results_rows.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "hydrodae/core/text.h"
#include "hydrodae/io/hdf5.h"
#include "hydrodae/io/output_place.h"

namespace hydrodae::io {

namespace {

using hdf5::checked;
using hdf5::Handle;

constexpr std::size_t rows_at_once = 512;

/// The columns of a file, time first, read in blocks of rows.
class RowReader {
public:
  RowReader(const std::string& path, const std::vector<Channel>& channels)
      : what_(path + ": cannot be read"),
        file_(checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, what_)) {
    add("time", 1);
    for (const Channel& channel : channels)
      add(channel.path, static_cast<std::size_t>(channel.width));
  }

  std::size_t width() const { return width_; } ///< number of columns with the time
  std::size_t rows() const { return rows_; }   ///< number of rows of the shortest column

  /// Rows first .. first + count - 1, one after the other.
  std::vector<double> block(std::size_t first, std::size_t count) const {
    std::vector<double> out(count * width_), values;
    std::size_t offset = 0;
    for (const Column& c : columns_) {
      values.resize(count * c.width);
      const hsize_t start[2] = {first, 0}, size[2] = {count, c.width};
      const Handle source = checked(H5Dget_space(c.dataset), H5Sclose, what_);
      checked(H5Sselect_hyperslab(source, H5S_SELECT_SET, start, nullptr, size, nullptr), what_);
      const Handle target =
          checked(H5Screate_simple(c.width == 1 ? 1 : 2, size, nullptr), H5Sclose, what_);
      checked(H5Dread(c.dataset, H5T_NATIVE_DOUBLE, target, source, H5P_DEFAULT, values.data()),
              what_);
      for (std::size_t row = 0; row < count; ++row)
        std::copy_n(values.data() + row * c.width, c.width, out.data() + row * width_ + offset);
      offset += c.width;
    }
    return out;
  }

private:
  struct Column {
    Handle dataset;
    std::size_t width;
  };

  void add(const std::string& name, std::size_t width) {
    Column c{checked(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, what_ + ": " + name),
             width};
    const Handle space = checked(H5Dget_space(c.dataset), H5Sclose, what_);
    hsize_t size[2] = {0, 1};
    if (H5Sget_simple_extent_ndims(space) != (width == 1 ? 1 : 2))
      throw CaseError(what_ + ": " + name + " has another shape");
    checked(H5Sget_simple_extent_dims(space, size, nullptr), what_);
    if (size[1] != width)
      throw CaseError(what_ + ": " + name + " has another width");
    rows_ = std::min(rows_, static_cast<std::size_t>(size[0]));
    width_ += width;
    columns_.push_back(std::move(c));
  }

  std::string what_;
  Handle file_;
  std::vector<Column> columns_;
  std::size_t width_ = 0, rows_ = static_cast<std::size_t>(-1);
};

bool holds(const std::string& path, const std::vector<Channel>& channels, std::size_t count,
           double time) {
  try {
    const RowReader reader(path, channels);
    return reader.rows() >= count && (count == 0 || reader.block(count - 1, 1)[0] == time);
  } catch (const CaseError&) { // no HDF5, cut off, or of another scene
    return false;
  }
}

} // namespace

EarlierRows::EarlierRows(const std::string& path, const std::vector<Channel>& channels,
                         std::size_t count, double time)
    : aside_(name_beside(path, "resumed")), channels_(channels), count_(count) {
  const hdf5::Quiet quiet;
  require_idle(path);
  const std::string partial = name_beside(path, "partial");
  for (const std::string& file : {partial, aside_, path})
    if (found_.empty() && holds(file, channels, count, time))
      found_ = file;
  if (found_.empty())
    throw CaseError(path + ": cannot be resumed: neither " + partial +
                    " nor itself holds the samples up to t = " + number_text(time) +
                    " s that the checkpoint follows");
  if (found_ != partial)
    return;
  if (std::rename(partial.c_str(), aside_.c_str()) != 0)
    throw CaseError(aside_ + ": cannot be made: " + std::strerror(errno));
  found_ = aside_;
}

void EarlierRows::copy(ResultsFile& to) const {
  const hdf5::Quiet quiet;
  const RowReader reader(found_, channels_);
  for (std::size_t first = 0; first < count_; first += rows_at_once) {
    const std::size_t rows = std::min(rows_at_once, count_ - first);
    const std::vector<double> block = reader.block(first, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      const double* values = block.data() + row * reader.width();
      to.append(values[0], {values + 1, reader.width() - 1});
    }
  }
}

void EarlierRows::drop() const {
  if (found_ == aside_)
    std::remove(aside_.c_str());
}

} // namespace hydrodae::io
