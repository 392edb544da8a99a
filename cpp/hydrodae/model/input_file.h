#pragma once
#include <string>
#include <vector>

namespace hydrodae::model {

/// Something outside the text of a case whose content the results depend on: a file that the case
/// reads, a library of laws, or a Python function.
struct InputFile {
  std::string key;    ///< of the case: "wave.sea.file"; "library", "forces.NAME" for what a caller
                      ///< gives
  std::string name;   ///< path as the case has it
  std::string path;   ///< path as it is opened; "" for a function
  std::string sha256; ///< of the content
};

/// The files with their digests, a line "SHA256 KEY = NAME" each: results, checkpoints, states and
/// journals of sweeps keep this text.
std::string text_of_files(const std::vector<InputFile>& files);

/// The first difference between two such texts in words, such as "wave.sea.file = sea.csv has
/// changed since"; empty: none.
std::string changed_file(const std::string& before, const std::string& now);

} // namespace hydrodae::model
