#include "hydrodae/cosim/json.h"

#include <cstdio>

#include "hydrodae/core/error.h"

namespace hydrodae::cosim {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      out += code;
    } else {
      out += c;
    }
  }
  return out + '"';
}

namespace {

class FlatReader {
public:
  explicit FlatReader(std::string_view text) : text_(text) {}

  std::map<std::string, std::string> object() {
    std::map<std::string, std::string> out;
    expect('{');
    if (!skip('}')) {
      do {
        const std::string name = string();
        expect(':');
        out[name] = peek() == '"' ? string() : word();
      } while (skip(','));
      expect('}');
    }
    if (peek() != '\0')
      refuse();
    return out;
  }

private:
  [[noreturn]] static void refuse() {
    throw Error("the handshake of the other program is no flat JSON object");
  }

  /// The next character that is no blank; 0 at the end.
  char peek() {
    while (next_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[next_]) != std::string_view::npos)
      ++next_;
    return next_ < text_.size() ? text_[next_] : '\0';
  }
  bool skip(char c) {
    if (peek() != c)
      return false;
    ++next_;
    return true;
  }
  void expect(char c) {
    if (!skip(c))
      refuse();
  }

  /// Escapes of other than the plain characters come out as "?": no name of ours has any.
  std::string string() {
    expect('"');
    std::string out;
    while (next_ < text_.size() && text_[next_] != '"') {
      char c = text_[next_++];
      if (c == '\\') {
        if (next_ >= text_.size())
          refuse();
        c = text_[next_++];
        if (c != '"' && c != '\\' && c != '/')
          c = '?';
      }
      out += c;
    }
    if (next_ >= text_.size())
      refuse();
    ++next_;
    return out;
  }

  std::string word() {
    peek();
    std::string out;
    const auto plain = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == 'E' || c == '+' || c == '-' ||
             c == '.';
    };
    while (next_ < text_.size() && plain(text_[next_]))
      out += text_[next_++];
    if (out.empty())
      refuse();
    return out;
  }

  std::string_view text_;
  std::size_t next_ = 0;
};

} // namespace

std::map<std::string, std::string> read_flat(std::string_view text) {
  return FlatReader(text).object();
}

} // namespace hydrodae::cosim
