#pragma once
/// Lists of numbers by name in an HDF5 file that is replaced in one step.

#include <map>
#include <string>

#include "hydrodae/core/archive.h"

namespace hydrodae::io {

using Texts = std::map<std::string, std::string>;

struct MemoryFile {
  Texts texts;                          ///< attributes of the root
  std::map<std::string, Memory> groups; ///< group / dataset
};

/// Writes beside `path` and renames: whoever is killed meanwhile leaves the file that was there.
/// Throws CaseError when it cannot be written.
void write_memory(const std::string& path, const MemoryFile& file);

/// The texts of the root of an HDF5 file.
Texts read_texts(const std::string& path);

/// Throws CaseError when it is no such file.
MemoryFile read_memory(const std::string& path);

} // namespace hydrodae::io
