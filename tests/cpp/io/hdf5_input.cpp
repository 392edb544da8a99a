// Damaged HDF5 files: what the library itself would read beyond its memory.

#include "hydrodae/io/hdf5_input.h"

#include <hdf5.h>

#include <array>
#include <fstream>
#include <iterator>

#include "support.h"

using namespace hydrodae;
using tests::contains;

namespace {

constexpr std::array<double, 4> numbers{1.25, -3.5, 7.0, 11.75};

/// A file whose dataset "x" keeps its numbers in its header.
void write_compact(const std::string& path) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t size = numbers.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr),
              properties = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_layout(properties, H5D_COMPACT);
  const hid_t set =
      H5Dcreate2(file, "x", H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
  H5Dclose(set);
  H5Pclose(properties);
  H5Sclose(space);
  H5Fclose(file);
}

} // namespace

TEST_CASE("a dataset whose header holds less than its shape needs is refused") {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "file.h5";
  write_compact(path);
  CHECK(io::hdf5::Input(path).list("x") == std::vector<double>(numbers.begin(), numbers.end()));

  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string data(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
  const std::size_t place = bytes.find(data);
  REQUIRE(place != std::string::npos);
  REQUIRE(static_cast<std::size_t>(bytes[place - 2]) == sizeof(numbers)); // two bytes: the size
  bytes[place - 2] = 8;
  std::ofstream(path, std::ios::binary) << bytes;
  CHECK(contains(tests::message_of([&] { io::hdf5::Input(path).list("x"); }),
                 "x: holds less data than its shape needs: the file is damaged"));
}
