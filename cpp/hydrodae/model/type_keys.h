#pragma once
/// Which keys an entry of a case file has by its `type`.

#include <string>
#include <vector>

namespace hydrodae::model {

/// Keys of a [[joint]], [[constraint]] or [[wave]] of this type; empty where the type is unknown,
/// or the kind of entry does not tell its keys apart by type.
std::vector<std::string> keys_of_type(const std::string& kind, const std::string& type);

/// Those of them that a [[wave]] of this type must have.
std::vector<std::string> needed_wave_keys(const std::string& type);

} // namespace hydrodae::model
