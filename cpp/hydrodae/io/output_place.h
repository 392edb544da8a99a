#pragma once
/// Place of a results file, locked against other writers.
///
/// The run writes `X.partial.h5` beside `X.h5` and renames it when it ends, so that an older `X.h5`
/// stands until then and what a killed run leaves has a name of its own. The lock is the kernel's,
/// on the partial file: it goes with the process.

#include <string>
#include <vector>

namespace hydrodae::io {

/// "X.partial.h5" for "X.h5" and "partial", beside what a link means.
std::string name_beside(const std::string& path, const std::string& what);

/// Throws CaseError when a run writes the partial file of `path`.
void require_idle(const std::string& path);

/// Throws CaseError unless `path` is free or holds a hydrodae results file, which may be replaced,
/// or when it is one of `inputs`, by whatever spelling or link.
void check_output(const std::string& path, const std::vector<std::string>& inputs);

class OutputPlace {
public:
  /// Checks `path` as `check_output` does. Touches nothing.
  explicit OutputPlace(const std::string& path);
  ~OutputPlace();
  OutputPlace(const OutputPlace&) = delete;
  OutputPlace& operator=(const OutputPlace&) = delete;

  const std::string& path() const { return path_; }
  const std::string& partial() const { return partial_; }

  /// Opens, locks and empties the partial file; returns its descriptor, which stays this object's.
  /// Throws CaseError before anything is lost: another run writes there, it is not what a run left
  /// that was cut off, or it cannot be made.
  int open();

  /// Gives the partial file its final name, in one step. Returns the reason of a failure, or "".
  std::string finish();

  /// Removes the partial file again; it stays open until this object goes.
  void discard();

private:
  bool try_lock();

  std::string path_, target_, partial_; ///< paths as given, behind links, and of the partial file
  int descriptor_ = -1;
};

} // namespace hydrodae::io
