// Texts of variable length in a damaged HDF5 file: the library would read them for ever.

#include "hydrodae/io/hdf5_collections.h"

#include <fstream>

#include "support.h"

using namespace hydrodae;
using tests::contains;

namespace {

std::string number(std::uint64_t value, int size) {
  std::string bytes;
  for (int k = 0; k < size; ++k)
    bytes.push_back(static_cast<char>(value >> 8 * k & 0xff));
  return bytes;
}

/// An object of a collection: its index, the length it claims, and its data.
std::string object(std::uint64_t index, std::uint64_t length, std::size_t data) {
  return number(index, 2) + number(0, 6) + number(length, 8) + std::string(data, 'x');
}

/// What is said of a file with one collection after 24 other bytes.
std::string said(std::uint64_t size, const std::string& objects) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder / "file.h5", std::ios::binary)
      << std::string(24, 'o') << std::string("GCOL\1\0\0\0", 8) << number(size, 8) << objects;
  return tests::message_of([&] { io::hdf5::check_collections(folder / "file.h5"); });
}

} // namespace

TEST_CASE("a sound collection is read") {
  CHECK(said(16 + 24 + 32 + 40, object(1, 5, 8) + object(2, 16, 16) + object(0, 40, 24)) ==
        "no error");
  CHECK(said(16 + 24 + 8, object(1, 8, 8) + std::string(8, '\0')) == "no error"); // no more room
}

TEST_CASE("a collection that the library would read for ever, or beyond, is refused") {
  const auto refused = [](std::uint64_t size, const std::string& objects) {
    return contains(said(size, objects), "damaged: a collection of texts at byte 24");
  };
  CHECK(refused(16 + 24 + 40, object(1, 5, 8) + object(0, 0, 24)));  // no size
  CHECK(refused(16 + 24 + 40, object(1, 5, 8) + object(0, 41, 24))); // too long
  CHECK(refused(16 + 24, object(1, 9, 8)));                          // too long
  CHECK(refused(16 + 24, object(1, ~std::uint64_t{0}, 8)));          // padding overflows
  CHECK(refused(16 + 24 + 1000, object(1, 8, 8)));                   // ends after the file
  CHECK(refused(8, object(1, 8, 8)));                                // shorter than itself
}
