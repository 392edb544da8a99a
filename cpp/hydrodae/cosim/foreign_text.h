#pragma once
#include <string>

namespace hydrodae::cosim {

/// Text of another program, to be shown in a message: what is no UTF-8, and control characters,
/// become '?'; no longer than so many bytes.
std::string foreign_text(const std::string& text, std::size_t longest = 4096);

/// A path as a part of a URI (RFC 3986): all but letters, digits and -._~/ by their codes.
std::string uri_text(const std::string& path);

/// Text in which bytes that are no UTF-8 become '?'.
std::string valid_utf8(std::string text);

} // namespace hydrodae::cosim
