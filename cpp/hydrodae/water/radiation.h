#pragma once
/// The ladder of radiation, cheapest rung first.

#include <tuple>
#include <type_traits>
#include <variant>

#include "hydrodae/water/radiation_constant.h"
#include "hydrodae/water/radiation_convolution.h"
#include "hydrodae/water/radiation_exponential.h"

namespace hydrodae::water {

struct NoRadiation : RadiationLaw {
  static constexpr std::string_view type = "none", doc = "added mass at infinite frequency only";
  bool operator==(const NoRadiation&) const { return true; }
};

/// Radiation of all bodies. A new rung is one header, and one entry here.
using Radiation = std::variant<NoRadiation, ConstantRadiation, ExponentialRadiation, Convolution>;

/// Calls `visit(std::type_identity<Rung>{})` for each rung, in the order of the ladder.
template <class Visit> constexpr void for_each_rung(Visit&& visit) {
  [&]<class... Rung>(std::type_identity<std::variant<Rung...>>) {
    (visit(std::type_identity<Rung>{}), ...);
  }(std::type_identity<Radiation>{});
}

/// Keys of one rung. Each rung has a base of its own, though most of them are empty.
template <class Rung> struct KeysOfRung : Rung::Keys {};
/// Keys of all rungs.
template <class List> struct KeysOfRungs;
template <class... Rung> struct KeysOfRungs<std::variant<Rung...>> : KeysOfRung<Rung>... {};
using RadiationKeys = KeysOfRungs<Radiation>;

} // namespace hydrodae::water
