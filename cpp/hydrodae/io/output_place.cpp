#include "hydrodae/io/output_place.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "hydrodae/io/hdf5_input.h"

namespace hydrodae::io {
namespace {

namespace fs = std::filesystem;

/// The file that a path means, behind symbolic links; what does not exist stays as it is written.
fs::path behind_links(fs::path path) {
  std::error_code error;
  for (int count = 0; count < 40 && fs::is_symlink(path, error); ++count)
    path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

/// Status of a hydrodae results file; nothing if it is another kind of file.
std::optional<std::string> results_status(const std::string& path) {
  try {
    const hdf5::Input file(path);
    if (file.has_attribute("/", "format") && file.text("/", "format") == "hydrodae-results")
      return file.text("/", "status");
  } catch (const CaseError&) { // no HDF5, or cut off
  }
  return std::nullopt;
}

/// Throws unless nothing is there or a results file.
void require_replaceable(const std::string& path, const fs::path& target) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (status.type() == fs::file_type::not_found)
    return;
  if (fs::is_directory(status))
    throw CaseError(path + ": is a folder; give the name of the results file in it");
  if (!fs::is_regular_file(status) || !results_status(target.string()))
    throw CaseError(path + ": exists and is no results file of hydrodae; it is not replaced: give "
                           "another name, or remove it");
}

/// A lock of this open file, which no other open file can have at the same time, not even in this
/// process. Readers that use flock, as HDF5 does, are not kept out. Returns 0 or errno.
int lock(int descriptor) {
#ifdef F_OFD_SETLK
  struct flock whole{};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(descriptor, F_OFD_SETLK, &whole) == 0 ? 0 : errno;
#else
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
#endif
}

} // namespace

std::string name_beside(const std::string& path, const std::string& what) {
  const fs::path file = behind_links(path);
  return (file.parent_path() / file.stem()).string() + "." + what + file.extension().string();
}

void require_idle(const std::string& path) {
  const std::string partial = name_beside(path, "partial");
  const int descriptor = ::open(partial.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0)
    return;
  const int error = lock(descriptor);
  ::close(descriptor);
  if (error == EAGAIN || error == EACCES)
    throw CaseError(path + ": cannot be resumed: another run is writing it (to " + partial + ")");
}

void check_output(const std::string& path, const std::vector<std::string>& inputs) {
  std::error_code ignored; // what does not exist is not the same
  for (const std::string& input : inputs)
    if (!input.empty() && fs::equivalent(path, input, ignored))
      throw CaseError(path + ": is the input " + input +
                      " itself, and no results file; it is not replaced: give another name");
  require_replaceable(path, behind_links(path));
}

OutputPlace::OutputPlace(const std::string& path)
    : path_(path), target_(behind_links(path).string()), partial_(name_beside(path, "partial")) {
  require_replaceable(path_, target_);
}

OutputPlace::~OutputPlace() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

/// False when the file that was locked has got its final name in the meantime.
bool OutputPlace::try_lock() {
  const auto refuse = [this](const std::string& why) {
    throw CaseError(path_ + ": cannot be written: " + why);
  };
  descriptor_ = ::open(partial_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor_ < 0)
    refuse(partial_ + ": " + std::strerror(errno));
  struct stat locked{}, named{};
  if (fstat(descriptor_, &locked) != 0 || !S_ISREG(locked.st_mode))
    refuse(partial_ + " is no regular file");
  const int error = lock(descriptor_);
  if (error == EAGAIN || error == EACCES)
    refuse("another run is writing it (to " + partial_ +
           "); wait for its end, or give another name");
  if (error != 0)
    refuse(std::string("the file system cannot lock files, so that two runs could destroy each "
                       "other's results; write to another folder (") +
           std::strerror(error) + ")");
  if (stat(partial_.c_str(), &named) == 0 && named.st_ino == locked.st_ino &&
      named.st_dev == locked.st_dev) {
    // Zeros up to the superblock: the run was killed before its first sample.
    unsigned char head[8] = {};
    const unsigned char zeros[8] = {};
    const ssize_t size = pread(descriptor_, head, sizeof head, 0);
    if (size > 0 && std::memcmp(head, zeros, sizeof head) != 0 &&
        results_status(partial_) != "running")
      refuse(partial_ + " exists and is not what a run left that was cut off; move it away");
    return true;
  }
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

int OutputPlace::open() {
  while (!try_lock()) {
  }
  if (ftruncate(descriptor_, 0) != 0)
    throw CaseError(path_ + ": cannot be written: " + std::strerror(errno));
  return descriptor_;
}

std::string OutputPlace::finish() {
  std::string why;
  try {
    require_replaceable(path_, target_); // somebody may have put something there during the run
    if (std::rename(partial_.c_str(), target_.c_str()) != 0)
      why = path_ + ": cannot be made: " + std::strerror(errno);
  } catch (const CaseError& error) {
    why = error.what();
  }
  ::close(descriptor_); // only now may another run begin
  descriptor_ = -1;
  return why;
}

void OutputPlace::discard() { unlink(partial_.c_str()); }

} // namespace hydrodae::io
