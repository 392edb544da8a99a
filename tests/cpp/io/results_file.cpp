#include "hydrodae/io/results_file.h"

#include <chrono>
#include <cmath>
#include <iostream>

#include "hydrodae/io/hdf5_input.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;
using io::hdf5::Handle;

namespace {

const std::vector<Channel> some_channels = {
    {"bodies/b/position", 3, "m", "world", "Centre of gravity."},
    {"energy/total", 1, "J", "-", "Energy."},
};

void append_rows(io::ResultsFile& file, int first, int last) {
  for (int i = first; i < last; ++i) {
    const double t = 0.1 * i;
    file.append(t, std::vector<double>{t, 2 * t, 3 * t, -t});
  }
}

std::vector<double> column(const std::string& path, const char* dataset, std::size_t& rows) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Handle data(H5Dopen2(file, dataset, H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(data), H5Sclose);
  hsize_t size[2] = {0, 1};
  H5Sget_simple_extent_dims(space, size, nullptr);
  std::vector<double> values(size[0] * size[1]);
  H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  rows = size[0];
  return values;
}

} // namespace

TEST_CASE("results come back as they were written") {
  const TemporaryFolder folder;
  const std::string path = folder / "results.h5";
  {
    io::ResultsFile file(path, some_channels, {{"title", std::string("Flügel")}, {"rows", 1300L}});
    append_rows(file, 0, 1300);
    file.close("completed", "", {{"steps", 42L}, {"wall_time", 0.5}});
  }
  std::size_t rows = 0;
  const std::vector<double> time = column(path, "time", rows);
  CHECK(rows == 1300);
  CHECK(time[1299] == 0.1 * 1299);
  const std::vector<double> position = column(path, "bodies/b/position", rows);
  CHECK(rows == 1300);
  bool equal = true;
  for (std::size_t i = 0; i < rows; ++i)
    equal = equal && position[3 * i] == time[i] && position[3 * i + 2] == 3 * time[i];
  CHECK(equal);
  CHECK(column(path, "energy/total", rows)[700] == -time[700]);

  const io::hdf5::Input file(path);
  CHECK(file.text("/", "format") == "hydrodae-results");
  CHECK(file.text("/", "title") == "Flügel");
  CHECK(file.text("/", "status") == "completed");
  CHECK(file.text("/bodies/b/position", "unit") == "m");
  CHECK(file.text("/bodies/b/position", "frame") == "world");
  CHECK(file.number("/", "rows") == 1300);
  CHECK(file.number("/solver", "steps") == 42);
  CHECK(file.number("/solver", "wall_time") == 0.5);
}

TEST_CASE("an unfinished file keeps what was flushed") {
  const TemporaryFolder folder;
  const std::string path = folder / "results.h5", partial = folder / "results.partial.h5",
                    copy = folder / "copy.h5";
  {
    io::ResultsFile file(path, some_channels, {});
    append_rows(file, 0, 1100);
    std::filesystem::copy_file(partial, copy); // what a killed process leaves
  }
  std::size_t rows = 0;
  const std::vector<double> time = column(copy, "time", rows);
  CHECK(rows == 1024);
  CHECK(time[1023] == 0.1 * 1023);
  CHECK(column(copy, "energy/total", rows)[1000] == -time[1000]);
  CHECK(io::hdf5::Input(copy).text("/", "status") == "running");
  column(partial, "time", rows); // the destructor wrote the rest
  CHECK(rows == 1100);
  CHECK(io::hdf5::Input(partial).text("/", "status") == "running");
  CHECK(!std::filesystem::exists(path));
}

TEST_CASE("a file that cannot be written is told") {
  const TemporaryFolder folder;
  const std::string path = folder / "none/results.h5";
  const std::string message = message_of([&] { io::ResultsFile file(path, some_channels, {}); });
  CHECK(message.starts_with(path + ": cannot be written: "));
  CHECK(contains(message, "No such file or directory"));
}

TEST_CASE("writing results is cheap" * doctest::skip()) { // run with --no-skip
  const TemporaryFolder folder;
  std::vector<Channel> many;
  for (int i = 0; i < 60; ++i)
    many.push_back({"forces/f" + std::to_string(i) + "/force", 3, "N", "world", "Some force."});
  std::vector<double> values(180);
  const auto start = std::chrono::steady_clock::now();
  io::ResultsFile file(folder / "results.h5", many, {});
  for (int i = 0; i < 1000; ++i) {
    for (double& value : values)
      value = std::sin(0.01 * i + value);
    file.append(0.1 * i, values);
  }
  file.close("completed", "", {});
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::cout << "1000 samples of 60 vectors: " << 1e3 * time.count() << " ms, "
            << std::filesystem::file_size(folder / "results.h5") << " bytes\n";
}
