#pragma once
/// Values of a case file as C++ values, checked against the description of their key.

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/field.h"

namespace hydrodae::io {

/// Description of an expected value and its place.
struct Key {
  std::string_view name;
  std::string_view unit;
  Range range;
  std::vector<std::string_view> choices;
  FilePlace place = {};
  std::string path = {};  ///< "body.flap1.mass"
  std::string label = {}; ///< "key 'mass' in [[body]] 'flap1'"
};

/// Place in the case file, or "--set solver.rtol" for a value from the command line.
FilePlace place_of(const toml::source_region& source);

/// Each throws CaseError on a wrong type, length, range or word.
void read_value(const toml::node& node, const Key& key, double& out);
void read_value(const toml::node& node, const Key& key, bool& out);
void read_value(const toml::node& node, const Key& key, int& out);
void read_value(const toml::node& node, const Key& key, std::string& out);
void read_value(const toml::node& node, const Key& key, std::vector<std::string>& out);
void read_value(const toml::node& node, const Key& key, std::vector<double>& out);
void read_value(const toml::node& node, const Key& key, std::vector<Vector3>& out);
void read_value(const toml::node& node, const Key& key, Vector3& out);
void read_value(const toml::node& node, const Key& key, Vector6& out);
void read_value(const toml::node& node, const Key& key, Matrix6& out);

template <class V> void read_value(const toml::node& node, const Key& key, std::optional<V>& out) {
  read_value(node, key, out.emplace());
}

/// A string must be one of the words of the key.
void read_value(const toml::node& node, const Key& key, ValueOrWord<double>& out);
void read_value(const toml::node& node, const Key& key, ValueOrWord<Vector3>& out);

} // namespace hydrodae::io
