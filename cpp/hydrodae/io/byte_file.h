#pragma once
/// Bytes with texts in an HDF5 file that is replaced in one step.

#include <map>
#include <string>

namespace hydrodae::io {

using Texts = std::map<std::string, std::string>;

struct ByteFile {
  Texts texts; ///< attributes of the root
  std::string bytes;
};

/// Writes beside `path` and renames: if the process is killed, the old file remains. Throws
/// CaseError if it cannot be written.
void write_bytes(const std::string& path, const ByteFile& file);

/// Texts of the root of an HDF5 file.
Texts read_texts(const std::string& path);

/// Throws CaseError if it is no such file.
ByteFile read_bytes(const std::string& path);

} // namespace hydrodae::io
