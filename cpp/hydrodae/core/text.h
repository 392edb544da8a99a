#pragma once
/// Text for messages.

#include <string>
#include <string_view>
#include <vector>

namespace hydrodae {

inline std::string in_quotes(std::string_view text) {
  std::string out(1, '\'');
  out.append(text);
  out.push_back('\'');
  return out;
}

/// Joined items "a, b, c", or with another separator.
template <class Range> std::string joined(const Range& items, std::string_view separator = ", ") {
  std::string text;
  for (const auto& item : items) {
    if (!text.empty())
      text += separator;
    text += item;
  }
  return text;
}

/// Short decimal form of a number for messages: 9.81, 1e-06.
std::string number_text(double value);

/// Number with the given digits; two for estimates.
std::string rounded_text(double value, int digits = 2);

/// Name in `names` that means `wanted`, a word of another code, or is nearest by edit distance; ""
/// if none is near.
std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names);

/// Text "; did you mean 'x'? (valid: ...)", or "; the list is empty" without names. Names in
/// `taken` are in use: they are valid, but not meant.
std::string suggestion(std::string_view wanted, const std::vector<std::string>& names,
                       const std::vector<std::string>& taken = {});

} // namespace hydrodae
