#include "hydrodae/io/ordered_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <tuple>

#include "hydrodae/io/ordered_driver.h"

namespace hydrodae::io {
namespace {

constexpr haddr_t superblock = 0;

bool begins_with(const unsigned char* data, std::size_t size, const char (&signature)[5]) {
  return size >= 4 && std::memcmp(data, signature, 4) == 0;
}

/// Level of a node of an index above its leaves.
int level(const std::vector<unsigned char>& bytes) {
  return bytes.size() > 5 && begins_with(bytes.data(), bytes.size(), "TREE") ? bytes[5] : 0;
}

} // namespace

hdf5::Handle OrderedFile::access_properties() { return ordered_access_properties(*this); }

haddr_t OrderedFile::end_of_file() const {
  haddr_t end = size_;
  for (const auto& [address, block] : pending_)
    end = std::max<haddr_t>(end, address + block.bytes.size());
  return end;
}

void OrderedFile::read(haddr_t address, std::size_t size, unsigned char* out) const {
  std::memset(out, 0, size); // beyond the end, as in a file with a hole
  for (std::size_t done = 0; descriptor_ >= 0 && done < size;) {
    const ssize_t n =
        pread(descriptor_, out + done, size - done, static_cast<off_t>(address + done));
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      break;
    done += static_cast<std::size_t>(n);
  }
  const haddr_t before =
      std::min<haddr_t>(address, longest_); // a block that reaches in may begin there
  for (auto next = pending_.lower_bound(address - before); next != pending_.end(); ++next) {
    const auto& [start, block] = *next;
    if (start >= address + size)
      break;
    const haddr_t first = std::max(start, address),
                  last = std::min<haddr_t>(start + block.bytes.size(), address + size);
    if (first < last)
      std::memcpy(out + (first - address), block.bytes.data() + (first - start), last - first);
  }
}

void OrderedFile::write(H5FD_mem_t type, haddr_t address, std::size_t size,
                        const unsigned char* data) {
  if (!failure_.empty())
    return;
  // The heap of texts comes as raw data. (So might four bytes of a number: then it waits, too.)
  const bool raw = type == H5FD_MEM_DRAW && !begins_with(data, size, "GCOL");
  if (raw && descriptor_ >= 0) {
    put(address, data, size);
    return;
  }
  auto next = pending_.upper_bound(address);
  if (next != pending_.begin()) {
    auto& [start, block] = *std::prev(next);
    if (address + size <= start + block.bytes.size()) { // a part of a block, or the same again
      std::memcpy(block.bytes.data() + (address - start), data, size);
      return;
    }
  }
  longest_ = std::max(longest_, size);
  pending_.insert_or_assign(address, Block{type, {data, data + size}});
}

void OrderedFile::put(haddr_t address, const unsigned char* data, std::size_t size) {
  if (observer_ && failure_.empty())
    observer_();
  for (std::size_t done = 0; failure_.empty() && done < size;) {
    const ssize_t n =
        pwrite(descriptor_, data + done, size - done, static_cast<off_t>(address + done));
    if (n >= 0)
      done += static_cast<std::size_t>(n);
    else if (errno != EINTR)
      failure_ = std::strerror(errno);
    size_ = std::max<haddr_t>(size_, address + done);
  }
}

void OrderedFile::put(const Blocks::value_type& block) {
  put(block.first, block.second.bytes.data(), block.second.bytes.size());
}

/// The file is as long as its superblock says, or a reader takes it for a truncated one.
void OrderedFile::resize() {
  if (!failure_.empty() || size_ == end_of_space_)
    return;
  if (observer_)
    observer_();
  if (ftruncate(descriptor_, static_cast<off_t>(end_of_space_)) != 0)
    failure_ = std::strerror(errno);
  else
    size_ = end_of_space_;
}

/// Blocks that are on disk already, in the order in which they may change.
std::vector<const OrderedFile::Blocks::value_type*> OrderedFile::changed_blocks() const {
  std::vector<const Blocks::value_type*> blocks;
  for (const auto& entry : pending_)
    if (entry.first != superblock && is_on_disk(entry.first))
      blocks.push_back(&entry);
  const auto order = [](const Blocks::value_type* b) {
    const bool header = b->second.type == H5FD_MEM_OHDR;
    return std::tuple(header, header ? 0 : -level(b->second.bytes), HADDR_MAX - b->first);
  };
  std::sort(blocks.begin(), blocks.end(),
            [&](const auto* a, const auto* b) { return order(a) < order(b); });
  return blocks;
}

void OrderedFile::commit() {
  for (const auto& entry : pending_)
    if (entry.first != superblock && !is_on_disk(entry.first))
      put(entry);
  if (size_ < end_of_space_)
    resize();
  const auto first = pending_.find(superblock);
  if (first != pending_.end())
    put(*first);
  if (failure_.empty() && first != pending_.end())
    committed_ = end_of_space_;
  for (const auto* entry : changed_blocks())
    put(*entry);
  if (!failure_.empty())
    return;
  for (const auto& entry : pending_)
    on_disk_.insert(entry.first);
  pending_.clear();
}

void OrderedFile::recover() {
  pending_.clear();
  failure_.clear();
  struct stat found{};
  if (ftruncate(descriptor_, static_cast<off_t>(committed_)) != 0 ||
      fstat(descriptor_, &found) != 0)
    failure_ = std::strerror(errno);
  else
    size_ = static_cast<haddr_t>(found.st_size);
  end_of_space_ = recovered_ = size_;
}

} // namespace hydrodae::io
