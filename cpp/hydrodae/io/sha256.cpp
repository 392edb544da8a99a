#include "hydrodae/io/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

#include "hydrodae/core/error.h"

namespace hydrodae::io {

namespace {

using Context = std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)>;

/// 64 hexadecimal digits; empty where it cannot be had.
std::string digest_of(const Context& context) {
  static constexpr char digits[] = "0123456789abcdef";
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_DigestFinal_ex(context.get(), digest.data(), &length) != 1)
    return "";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += digits[digest[i] >> 4];
    text += digits[digest[i] & 15];
  }
  return text;
}

} // namespace

std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  bool good =
      file.good() && context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::vector<char> block(1 << 16);
  while (good && file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    good = EVP_DigestUpdate(context.get(), block.data(), count) == 1;
  }
  const std::string text = good && file.eof() ? digest_of(context) : "";
  if (text.empty())
    throw CaseError(path + ": cannot compute the SHA-256 of the file");
  return text;
}

std::string sha256_of_text(const std::string& text) {
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  const bool good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1 &&
                    EVP_DigestUpdate(context.get(), text.data(), text.size()) == 1;
  const std::string out = good ? digest_of(context) : "";
  if (out.empty())
    throw CaseError("cannot compute the SHA-256 of a text");
  return out;
}

} // namespace hydrodae::io
