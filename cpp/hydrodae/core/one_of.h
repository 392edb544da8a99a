#pragma once
/// Entries of a list whose key `type` selects one of several structs.

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hydrodae/core/field.h"

namespace hydrodae {

/// Value of one of `Types`. Each type derives from `Shared`, names its `type` and `doc` as
/// constants, and declares its keys by `fields()`.
template <class Shared, class... Types> class OneOf {
public:
  OneOf() = default;
  template <class T>
    requires(std::same_as<T, Types> || ...)
  OneOf(T value) : value_(std::move(value)) {} // NOLINT: an entry is any of its types

  Shared* operator->() {
    return std::visit([](auto& value) -> Shared* { return &value; }, value_);
  }
  const Shared* operator->() const {
    return std::visit([](const auto& value) -> const Shared* { return &value; }, value_);
  }

  std::string_view type() const {
    return std::visit([](const auto& value) { return std::decay_t<decltype(value)>::type; },
                      value_);
  }

  /// Entry as a `T` (one of the types, or a base of some), or null if it is no `T`.
  template <class T> const T* as() const {
    return std::visit(
        [](const auto& value) -> const T* {
          if constexpr (std::derived_from<std::decay_t<decltype(value)>, T>)
            return &value;
          else
            return nullptr;
        },
        value_);
  }
  template <class T> T* as() { return const_cast<T*>(std::as_const(*this).template as<T>()); }

  /// Calls `f` with the struct of the entry.
  template <class F> decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), value_);
  }
  template <class F> decltype(auto) visit(F&& f) { return std::visit(std::forward<F>(f), value_); }

  /// Calls `f(std::type_identity<T>{})` for each of the types, in their order.
  template <class F> static void for_each_type(const F& f) {
    (f(std::type_identity<Types>{}), ...);
  }

private:
  std::variant<Types...> value_;
};

template <class T> inline constexpr bool is_one_of = false;
template <class S, class... T> inline constexpr bool is_one_of<OneOf<S, T...>> = true;

/// Name of an entry of any kind.
template <class T> const std::string& name_of_entry(const T& entry) {
  if constexpr (is_one_of<T>)
    return entry->name;
  else
    return entry.name;
}

} // namespace hydrodae
