#pragma once
#include <string>
#include <vector>

namespace hydrodae::model {

/// External content that the results depend on: a file that the case reads, a library of laws, or a
/// Python function.
struct InputFile {
  /// Key of the case: "wave.sea.file"; for content from the caller "library", "forces.NAME"
  std::string key;
  std::string name;   ///< path as in the case
  std::string path;   ///< path that is opened; "" for a function
  std::string sha256; ///< digest of the content
};

/// Files with their digests, one line "SHA256 KEY = NAME" each. Results, checkpoints, states and
/// sweep journals store this text.
std::string text_of_files(const std::vector<InputFile>& files);

/// First difference between two such texts, such as "wave.sea.file = sea.csv has changed since";
/// empty: none.
std::string changed_file(const std::string& before, const std::string& now);

} // namespace hydrodae::model
