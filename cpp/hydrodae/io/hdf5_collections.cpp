#include "hydrodae/io/hdf5_collections.h"

#include <cstdint>
#include <fstream>
#include <iterator>

#include "hydrodae/core/error.h"

namespace hydrodae::io::hdf5 {
namespace {

constexpr std::size_t header = 16; ///< bytes of the header of a collection, and of an object

/// Little-endian number of `size` bytes.
std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t k = size; k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// Do the objects of the collection at `start` follow each other up to its end?
bool sound(const std::string& bytes, std::size_t start, std::uint64_t size) {
  std::uint64_t at = header;
  while (size - at >= header) {
    const std::uint64_t index = number_at(bytes, start + at, 2);
    const std::uint64_t length = number_at(bytes, start + at + 8, 8);
    if (length > size - at)
      return false;
    // index 0 is the free space, header included; others are padded to eight bytes
    const std::uint64_t taken = index == 0 ? length : header + (length + 7) / 8 * 8;
    if (taken < header || taken > size - at)
      return false;
    at += taken;
  }
  return true;
}

} // namespace

void check_collections(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::string bytes(file ? static_cast<std::size_t>(file.tellg()) : 0, '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  const std::string mark("GCOL\1\0\0\0", 8);
  for (std::size_t at = 0; (at = bytes.find(mark, at)) != std::string::npos; at += mark.size()) {
    if (bytes.size() - at < header)
      return;
    const std::uint64_t size = number_at(bytes, at + 8, 8);
    if (size < header || size > bytes.size() - at || !sound(bytes, at, size))
      throw CaseError(path + ": damaged: a collection of texts at byte " + std::to_string(at) +
                      " is not readable");
  }
}

} // namespace hydrodae::io::hdf5
