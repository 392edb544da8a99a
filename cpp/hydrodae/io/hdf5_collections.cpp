#include "hydrodae/io/hdf5_collections.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "hydrodae/core/error.h"

namespace hydrodae::io::hdf5 {
namespace {

constexpr std::size_t piece = 1 << 22; ///< bytes of a file that are in memory at once, whole pages
constexpr std::size_t header = 16;     ///< bytes of the header of a collection, and of an object

/// Little-endian number of `size` bytes.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t k = size; k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// Returns whether the objects of the collection at `start` follow each other up to its end.
bool sound(std::string_view bytes, std::size_t start, std::uint64_t size) {
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

/// Bytes of a file, without a copy; empty for a file that cannot be read.
class MappedFile {
public:
  explicit MappedFile(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status{};
    if (descriptor >= 0 && fstat(descriptor, &status) == 0 && status.st_size > 0) {
      size_ = static_cast<std::size_t>(status.st_size);
      start_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    }
    if (descriptor >= 0)
      ::close(descriptor);
  }
  ~MappedFile() {
    if (start_ != MAP_FAILED)
      munmap(start_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const {
    return start_ == MAP_FAILED ? std::string_view()
                                : std::string_view(static_cast<const char*>(start_), size_);
  }

  /// Leaves the memory of the piece from `first` on to others.
  void forget(std::size_t first) const {
    madvise(static_cast<char*>(start_) + first, std::min(piece, size_ - first), MADV_DONTNEED);
  }

private:
  void* start_ = MAP_FAILED;
  std::size_t size_ = 0;
};

} // namespace

void check_collections(const std::string& path) {
  constexpr std::string_view mark("GCOL\1\0\0\0", 8);
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  for (std::size_t first = 0; first < bytes.size(); first += piece) {
    const std::string_view here = bytes.substr(first, piece + mark.size() - 1);
    for (std::size_t k = 0; (k = here.find(mark, k)) != std::string_view::npos; k += mark.size()) {
      const std::size_t at = first + k;
      if (bytes.size() - at < header)
        return;
      const std::uint64_t size = number_at(bytes, at + 8, 8);
      if (size < header || size > bytes.size() - at || !sound(bytes, at, size))
        throw CaseError(path + ": damaged: a collection of texts at byte " + std::to_string(at) +
                        " is not readable");
    }
    file.forget(first);
  }
}

} // namespace hydrodae::io::hdf5
