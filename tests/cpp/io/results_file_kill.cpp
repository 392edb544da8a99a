/// What a process that is killed leaves of a results file.

#include <filesystem>

#include "hydrodae/io/hdf5_input.h"
#include "hydrodae/io/results_file.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;
using io::hdf5::Handle;

namespace {

namespace fs = std::filesystem;

/// Enough channels for groups of groups, and for headers that go on elsewhere in the file.
std::vector<Channel> many_channels() {
  std::vector<Channel> channels;
  for (int i = 0; i < 12; ++i)
    channels.push_back({"bodies/b" + std::to_string(i) + "/position", 3, "m", "world", "Where."});
  channels.push_back({"solver/step", 1, "s", "-", "Step."});
  return channels;
}

constexpr std::size_t values_in_row = 12 * 3 + 1;

/// Row i: time i, and i + k in the k-th value.
void append_row(io::ResultsFile& file, int i) {
  std::vector<double> values(values_in_row);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = i + static_cast<double>(k);
  file.append(i, values);
}

struct Found {
  std::string status;
  std::size_t rows = 0; ///< of `time`, which no channel falls short of
};

/// Reads every channel; fails the test where one is shorter than `time` or holds other values.
Found read_all(const std::string& path) {
  const io::hdf5::Input header(path);
  Found found{header.text("/", "status"), 0};
  CHECK(header.text("/", "title") == "kill");
  CHECK(header.text("/", "message").size() < 100);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  std::vector<Channel> channels = many_channels();
  channels.insert(channels.begin(), {"time", 1, "s", "-", "Time."});
  std::size_t offset = 0;
  for (const Channel& channel : channels) {
    const auto width = static_cast<std::size_t>(channel.width);
    const Handle data(H5Dopen2(file, channel.path.c_str(), H5P_DEFAULT), H5Dclose);
    REQUIRE(data >= 0);
    const Handle space(H5Dget_space(data), H5Sclose);
    hsize_t size[2] = {0, 1};
    H5Sget_simple_extent_dims(space, size, nullptr);
    std::vector<double> values(size[0] * size[1]);
    REQUIRE(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    if (channel.path == "time")
      found.rows = size[0];
    CHECK(size[0] >= found.rows);
    bool equal = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto row = i / width, column = i % width;
      const auto expected = channel.path == "time" ? row : row + offset + column;
      equal = equal && values[i] == static_cast<double>(expected);
    }
    CHECK_MESSAGE(equal, channel.path << " in " << path);
    if (channel.path != "time")
      offset += width;
  }
  return found;
}

/// Writes rows with a commit now and then; 40 000 of them give indices a second level.
void write_all(const std::string& path, const io::WriteObserver& observer, int rows,
               int rows_per_commit) {
  io::ResultsFile file(path, many_channels(), {{"title", std::string("kill")}}, observer);
  for (int i = 0; i < rows; ++i) {
    append_row(file, i);
    if (i % rows_per_commit == rows_per_commit - 1)
      file.flush();
  }
  file.close("completed", "all is well", {{"steps", 7L}, {"method", std::string("ida")}});
}

} // namespace

TEST_CASE("a file is whole before every single write to the disk") {
  const TemporaryFolder folder;
  const std::string path = folder / "results.h5", partial = folder / "results.partial.h5";
  long writes = 0, kept = 0, empty = 0;
  std::size_t rows_before = 0;
  const auto look = [&] {
    ++writes;
    // All writes of the beginning, of the end, and some of those between.
    if (writes > 400 && writes % 97 != 0 && writes < 30000)
      return;
    fs::copy_file(partial, folder / "copy.h5", fs::copy_options::overwrite_existing);
    ++kept;
    if (H5Fis_hdf5((folder / "copy.h5").c_str()) <= 0) {
      ++empty; // the superblock is the last block of the first commit
      CHECK(rows_before == 0);
      return;
    }
    const Found found = read_all(folder / "copy.h5");
    CHECK(found.rows >= rows_before);
    rows_before = found.rows;
  };
  write_all(path, look, 40000, 1000);
  CHECK(read_all(path).rows == 40000);
  CHECK(read_all(path).status == "completed");
  MESSAGE(writes << " writes, " << kept << " looked at, " << empty << " before the first commit");
}
