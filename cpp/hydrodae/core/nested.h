#pragma once
/// Properties of a struct of fields besides `fields()`, from its members.

#include <concepts>
#include <string_view>
#include <type_traits>

namespace hydrodae {

/// Struct of a list that is read by `type`: it names its type as a constant, and the key is no
/// field.
template <class T>
concept NamedType = std::same_as<decltype(&T::type), const std::string_view*>;

/// Sentence of meaning; "" if absent.
template <class T> constexpr std::string_view doc_of() {
  if constexpr (requires { T::doc; })
    return T::doc;
  else
    return "";
}

/// Calls `visit(name, member)` for each table that stands inside one of T: `initial`, `drive`
/// and `crest`.
template <class T, class Visit> void for_each_nested(const Visit& visit) {
  if constexpr (requires(T value) { value.initial; })
    visit("initial", &T::initial);
  if constexpr (requires(T value) { value.drive; })
    visit("drive", &T::drive);
  if constexpr (requires(T value) { value.crest; })
    visit("crest", &T::crest);
}

} // namespace hydrodae
