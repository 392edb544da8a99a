#pragma once
#include <string>

namespace hydrodae::io {

/// SHA-256 of a file's bytes as 64 hexadecimal digits. Throws CaseError when it cannot be read.
std::string sha256_of_file(const std::string& path);

/// SHA-256 of a text.
/// @param instructions  false: without those of the processor for it
std::string sha256_of_text(const std::string& text, bool instructions = true);

} // namespace hydrodae::io
