#pragma once
/// Subset of JSON that a handshake needs.

#include <map>
#include <string>
#include <string_view>

namespace hydrodae::cosim {

/// The text as a JSON string, in quotes.
std::string quoted(std::string_view text);

/// The members of one object without inner objects or lists: strings as they read, numbers and
/// words as they are written. Throws Error on anything else.
std::map<std::string, std::string> read_flat(std::string_view text);

} // namespace hydrodae::cosim
