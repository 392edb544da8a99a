#include "hydrodae/run/state.h"

#include <algorithm>

#include "hydrodae/io/sha256.h"

namespace hydrodae::run {

namespace {

constexpr std::string_view head = "hydrodae state 2\n";
constexpr std::size_t digest_size = 64; ///< length of the SHA-256 digest at the end

} // namespace

std::string sealed(const std::string& bytes) {
  const std::string out = std::string(head) + bytes;
  return out + io::sha256_of_text(out);
}

std::string unsealed(const std::string& bytes) {
  const std::string content = bytes.substr(0, bytes.size() - std::min(bytes.size(), digest_size));
  if (!content.starts_with(head) || io::sha256_of_text(content) != bytes.substr(content.size()))
    throw Error("these bytes are no state of a hydrodae run");
  return content.substr(head.size());
}

std::string State::bytes() const { return sealed(to_bytes(*this)); }

State State::from_bytes(const std::string& bytes) {
  return hydrodae::from_bytes<State>(unsealed(bytes));
}

} // namespace hydrodae::run
