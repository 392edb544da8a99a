#pragma once
/// What a struct of fields says of itself beside `fields()`, read off its members.

#include <concepts>
#include <string_view>
#include <type_traits>

namespace hydrodae {

/// Entries of a list that is read by its `type` name it as a constant; the key itself is no field.
template <class T>
concept NamedType = std::same_as<decltype(&T::type), const std::string_view*>;

/// One sentence of meaning, "" if absent.
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
