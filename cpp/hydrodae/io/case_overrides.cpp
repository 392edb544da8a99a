#include "hydrodae/io/case_overrides.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::io {
namespace {

constexpr std::string_view option = "--set ";

/// `place`: "--set solver.rtol".
[[noreturn]] void refuse(const std::string& place, const std::string& fault) {
  throw CaseError({place}, place.substr(option.size()), fault);
}

std::vector<std::string> split(const std::string& key, const std::string& place) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  while (true) {
    const std::size_t dot = key.find('.', start);
    parts.push_back(key.substr(start, dot - start));
    if (parts.back().empty())
      refuse(place, "expected a dotted key such as solver.rtol or joint.hinge1.type");
    if (dot == std::string::npos)
      return parts;
    start = dot + 1;
  }
}

/// A word of letters, digits and "._/+-" needs no quotes on the command line.
bool is_bare_word(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto fits = [&](char c) {
    return letter(c) || (c >= '0' && c <= '9') ||
           std::string_view("._/+-").find(c) != std::string_view::npos;
  };
  if (text.empty() || !std::all_of(text.begin(), text.end(), fits))
    return false;
  return letter(text[0]) || text[0] == '_' || text[0] == '/' || text[0] == '.';
}

/// The table { value = <text> }.
toml::table parse_value(const std::string& text, const std::string& place) {
  try {
    toml::table parsed = toml::parse("value = " + text, place);
    if (parsed.size() == 1)
      return parsed;
  } catch (const toml::parse_error&) {
    if (is_bare_word(text))
      return toml::parse("value = '" + text + "'", place);
  }
  refuse(place,
         "the value " + in_quotes(text) + " is not TOML (numbers, true, false, \"text\", [lists])");
}

toml::table& entry_of(toml::array& list, const std::string& kind, const std::string& name,
                      const std::string& place) {
  std::vector<std::string> names;
  for (toml::node& item : list) {
    toml::table* table = item.as_table();
    if (!table)
      continue;
    const std::string other = (*table)["name"].value_or(std::string());
    if (other == name)
      return *table;
    names.push_back(other);
  }
  refuse(place, "no " + kind + " " + in_quotes(name) + suggestion(name, names));
}

toml::source_region source_of(const std::string& place) {
  return {{1, 1}, {1, 1}, std::make_shared<const std::string>(place)};
}

/// The table under `part`, made if it is missing.
toml::node& step_into(toml::table& table, const std::string& part, const std::string& place) {
  if (!table.contains(part))
    table.emplace<toml::table>(toml::key(part, source_of(place)));
  return *table.get(part);
}

toml::table& owner_of(toml::table& root, const std::vector<std::string>& parts,
                      const std::string& place) {
  toml::table* table = &root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    toml::node& node = step_into(*table, parts[i], place);
    if (toml::array* list = node.as_array()) {
      if (i + 2 >= parts.size())
        refuse(place, "expected " + parts[i] + ".<name>.<key>");
      table = &entry_of(*list, parts[i], parts[i + 1], place);
      ++i;
    } else if (node.is_table()) {
      table = node.as_table();
    } else {
      refuse(place, "" + in_quotes(parts[i]) + " is a value, it holds no keys");
    }
  }
  return *table;
}

} // namespace

void apply_overrides(toml::table& root, const Overrides& overrides) {
  for (const auto& [key, text] : overrides) {
    const std::string place = std::string(option) + key;
    const std::vector<std::string> parts = split(key, place);
    toml::table value = parse_value(text, place);
    toml::table& owner = owner_of(root, parts, place);
    owner.erase(parts.back());
    value.get("value")->visit([&](auto& node) {
      owner.insert_or_assign(toml::key(parts.back(), source_of(place)), std::move(node));
    });
  }
}

} // namespace hydrodae::io
