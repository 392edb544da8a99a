#pragma once
/// Which keys an entry of a case file has by its `type`.

#include <string>
#include <vector>

namespace hydrodae::model {

/// Keys of a [[joint]], [[constraint]], [[controller]] or [[wave]] of this type, or of the table
/// inside it that `kind` names ("joint.initial"); empty where the type is unknown, or the kind of
/// entry does not tell its keys apart by type.
std::vector<std::string> keys_of_type(const std::string& kind, const std::string& type);

/// Those that an entry of this type must have beside what every entry of its kind must have.
std::vector<std::string> needed_keys(const std::string& kind, const std::string& type);

/// One sentence of meaning of a type of joint, constraint or wave; "" for another.
std::string doc_of_type(const std::string& kind, const std::string& type);

} // namespace hydrodae::model
