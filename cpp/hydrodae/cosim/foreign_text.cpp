#include "hydrodae/cosim/foreign_text.h"

#include <cctype>
#include <string_view>

namespace hydrodae::cosim {

namespace {

/// Bytes of the UTF-8 character that begins at k (RFC 3629); 0: none does.
std::size_t character_size(const std::string& text, std::size_t k) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(k);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xC2 ? 0
                           : first < 0xE0 ? 2
                           : first < 0xF0 ? 3
                           : first < 0xF5 ? 4
                                          : 0;
  if (size == 0 || k + size > text.size())
    return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(k + i) & 0xC0) != 0x80)
      return 0;
  const unsigned second = size > 1 ? byte(k + 1) : 0;
  const bool wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return wrong ? 0 : size;
}

} // namespace

std::string valid_utf8(std::string text) {
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t size = character_size(text, k);
    if (size == 0)
      text[k] = '?';
    k += size == 0 ? 1 : size;
  }
  return text;
}

std::string foreign_text(const std::string& text, std::size_t longest) {
  std::string out = text.substr(0, longest);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      c = '?';
  return valid_utf8(std::move(out));
}

std::string uri_text(const std::string& path) {
  constexpr std::string_view plain = "-._~/", digits = "0123456789ABCDEF";
  std::string out;
  for (const char c : path) {
    const auto code = static_cast<unsigned char>(c);
    if ((code < 128 && std::isalnum(code)) || plain.find(c) != plain.npos)
      out += c;
    else
      out += {'%', digits[code / 16], digits[code % 16]};
  }
  return out;
}

} // namespace hydrodae::cosim
