#pragma once
#include <span>
#include <string>
#include <string_view>

namespace hydrodae::line {

/// Reason why the load of a law of this type with the inputs `in` is not a number; empty: unknown.
std::string trouble(std::string_view type, std::span<const double> in);

} // namespace hydrodae::line
