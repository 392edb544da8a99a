#include "hydrodae/core/field.h"

namespace hydrodae {

AnyField any_field(std::string_view key, std::ptrdiff_t offset, Value (*value)(void*),
                   std::string_view unit, std::string_view doc, bool required, const Range& range,
                   const std::vector<std::string_view>& choices) {
  return {key, offset, value, unit, doc, required, range, choices};
}

} // namespace hydrodae
