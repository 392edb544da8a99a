#pragma once
#include <span>
#include <string>
#include <string_view>

namespace hydrodae::line {

/// Why a law of this type that sees the numbers `in` has a load that is no number, in words; empty:
/// nothing is known of it.
std::string trouble(std::string_view type, std::span<const double> in);

} // namespace hydrodae::line
