#include "hydrodae/run/state.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "hydrodae/io/sha256.h"

namespace hydrodae::run {

namespace {

constexpr std::string_view head = "hydrodae state 1\n";
constexpr std::size_t digest_size = 64; ///< of the SHA-256 at the end

[[noreturn]] void refuse_bytes() { throw Error("these bytes are no state of a hydrodae run"); }

/// Texts and lists of numbers one after the other, each behind its length.
class ByteReader {
public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  bool done() const { return next_ == bytes_.size(); }

  void skip(std::string_view expected) {
    if (bytes_.compare(next_, expected.size(), expected) != 0)
      refuse_bytes();
    next_ += expected.size();
  }

  template <class List> List list() {
    std::uint64_t count = 0;
    copy(&count, 1, sizeof count);
    List out;
    if (count > (bytes_.size() - next_) / sizeof(out[0]))
      refuse_bytes();
    out.resize(count);
    copy(out.data(), count, sizeof(out[0]));
    return out;
  }

private:
  void copy(void* out, std::size_t count, std::size_t size) {
    if ((bytes_.size() - next_) / size < count)
      refuse_bytes();
    if (count > 0)
      std::memcpy(out, bytes_.data() + next_, count * size);
    next_ += count * size;
  }

  const std::string& bytes_;
  std::size_t next_ = 0;
};

template <class List> void put_list(const List& list, std::string& bytes) {
  const std::uint64_t count = list.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(list.data()), count * sizeof(list[0]));
}

} // namespace

Memory State::numbers() const {
  Memory out = memory;
  out["time"] = {time};
  out["y"] = {y.begin(), y.end()};
  out["yp"] = {yp.begin(), yp.end()};
  return out;
}

State State::from_numbers(Memory numbers, std::string scene) {
  State out;
  out.scene = std::move(scene);
  const auto take = [&](const char* name) {
    const auto node = numbers.extract(name);
    if (node.empty())
      refuse_bytes();
    return node.mapped();
  };
  const std::vector<double> time = take("time"), y = take("y"), yp = take("yp");
  if (time.size() != 1 || y.size() != yp.size())
    refuse_bytes();
  out.time = time[0];
  out.y = Eigen::Map<const VectorX>(y.data(), static_cast<Eigen::Index>(y.size()));
  out.yp = Eigen::Map<const VectorX>(yp.data(), static_cast<Eigen::Index>(yp.size()));
  out.memory = std::move(numbers);
  return out;
}

std::string State::bytes() const {
  std::string out(head);
  put_list(scene, out);
  for (const auto& [name, values] : numbers()) {
    put_list(name, out);
    put_list(values, out);
  }
  return out + io::sha256_of_text(out);
}

State State::from_bytes(const std::string& bytes) {
  const std::size_t size = bytes.size() - std::min(bytes.size(), digest_size);
  const std::string content = bytes.substr(0, size);
  if (io::sha256_of_text(content) != bytes.substr(size))
    refuse_bytes();
  ByteReader reader(content);
  reader.skip(head);
  std::string scene = reader.list<std::string>();
  Memory numbers;
  while (!reader.done()) {
    std::string name = reader.list<std::string>();
    numbers[std::move(name)] = reader.list<std::vector<double>>();
  }
  return from_numbers(std::move(numbers), std::move(scene));
}

} // namespace hydrodae::run
