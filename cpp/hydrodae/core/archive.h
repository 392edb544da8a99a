#pragma once
/// Conversion of values to bytes and back. A State is a plain struct without base classes or
/// constructors: its members are found here, without a list of them.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/types.h"

namespace hydrodae {

/// Calls `visit` with all members of a plain struct at once, in their order: at most 16. The number
/// of members is the number of accepted initialisers.
template <class Struct, class Visit>
  requires std::is_aggregate_v<std::remove_const_t<Struct>>
void visit_members(Struct& value, Visit&& visit) {
  using T = std::remove_const_t<Struct>;
  // clang-format off
  static_assert(!requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; },
                "a plain struct with more than 16 members: nest them");
  if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    visit(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i, j] = value;
    visit(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    visit(a, b, c, d, e, f, g, h, i);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g, h] = value;
    visit(a, b, c, d, e, f, g, h);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f, g] = value;
    visit(a, b, c, d, e, f, g);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e, f] = value;
    visit(a, b, c, d, e, f);
  } else if constexpr (requires { T{{}, {}, {}, {}, {}}; }) {
    auto& [a, b, c, d, e] = value;
    visit(a, b, c, d, e);
  } else if constexpr (requires { T{{}, {}, {}, {}}; }) {
    auto& [a, b, c, d] = value;
    visit(a, b, c, d);
  } else if constexpr (requires { T{{}, {}, {}}; }) {
    auto& [a, b, c] = value;
    visit(a, b, c);
  } else if constexpr (requires { T{{}, {}}; }) {
    auto& [a, b] = value;
    visit(a, b);
  } else if constexpr (requires { T{{}}; }) {
    auto& [a] = value;
    visit(a);
  }
  // clang-format on
}

/// Archive that appends values to a string of bytes, or reads them in the same order; for this kind
/// of machine. Throws Error if there are too few or too many bytes.
class Archive {
public:
  explicit Archive(std::string& out) : out_(&out) {}   ///< writes
  explicit Archive(std::string_view in) : left_(in) {} ///< reads

  template <class T> void operator()(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      raw(&value, sizeof value);
    else if constexpr (std::is_aggregate_v<T>)
      visit_members(value, [this](auto&... member) { ((*this)(member), ...); });
    else
      take(value);
  }

  /// Checks that no bytes are left; call it after the last value that is read.
  void finish() const {
    if (!left_.empty())
      misfit();
  }

private:
  [[noreturn]] static void misfit() {
    throw Error("a saved state does not fit this run: it was made for another scene or by another "
                "version of hydrodae");
  }

  bool writes() const { return out_ != nullptr; }

  void raw(void* value, std::size_t bytes) {
    if (writes()) {
      out_->append(static_cast<const char*>(value), bytes);
      return;
    }
    if (left_.size() < bytes)
      misfit();
    if (bytes > 0)
      std::memcpy(value, left_.data(), bytes);
    left_.remove_prefix(bytes);
  }

  /// Number of elements of a list, each of which takes at least `least` bytes.
  std::size_t size(std::size_t now, std::size_t least = 1) {
    auto value = static_cast<std::uint64_t>(now);
    raw(&value, sizeof value);
    if (!writes() && value > left_.size() / least)
      misfit();
    return static_cast<std::size_t>(value);
  }

  template <class List> void list(List& v) {
    v.resize(size(v.size()));
    for (auto& x : v)
      (*this)(x);
  }
  template <class List> void contiguous(List& v) {
    v.resize(size(v.size(), sizeof(v[0])));
    raw(v.data(), v.size() * sizeof(v[0]));
  }

  void take(std::string& v) { contiguous(v); }
  template <class T> void take(std::deque<T>& v) { list(v); }
  template <class T> void take(std::vector<T>& v) {
    if constexpr (std::is_arithmetic_v<T>)
      contiguous(v);
    else
      list(v);
  }

  template <int rows, int columns> void take(Eigen::Matrix<double, rows, columns>& m) {
    const auto own = [](Eigen::Index n) { return static_cast<std::size_t>(n); };
    const std::size_t n = size(own(m.rows()), sizeof(double)),
                      k = columns == 1 ? 1 : size(own(m.cols()), sizeof(double));
    if (!writes() && n > 0 && k > left_.size() / sizeof(double) / n)
      misfit();
    m.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k));
    raw(m.data(), n * k * sizeof(double));
  }

  template <class A, class B> void take(std::pair<A, B>& v) {
    (*this)(v.first);
    (*this)(v.second);
  }

  template <class T> void take(std::optional<T>& v) {
    if (size(v.has_value()) == 0)
      v.reset();
    else
      (*this)(v ? *v : v.emplace());
  }

  template <class... Ts> void take(std::variant<Ts...>& v) {
    const std::size_t which = size(v.index(), 1);
    if (!writes()) {
      std::size_t k = 0;
      const bool known = ((k++ == which && (v.template emplace<Ts>(), true)) || ...);
      if (!known)
        misfit();
    }
    std::visit([this](auto& value) { (*this)(value); }, v);
  }

  std::string* out_ = nullptr;
  std::string_view left_;
};

/// Value as bytes.
template <class T> std::string to_bytes(const T& value) {
  std::string out;
  Archive archive(out);
  archive(const_cast<T&>(value)); // only reads
  return out;
}

/// Value from bytes. Throws Error; see Archive.
template <class T> T from_bytes(std::string_view bytes) {
  T out;
  Archive archive(bytes);
  archive(out);
  archive.finish();
  return out;
}

} // namespace hydrodae
