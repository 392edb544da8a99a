#pragma once
#include "hydrodae/core/text.h"
#include "hydrodae/model/condition.h"

namespace hydrodae::model {

/// Coupled coordinates, s_b - s_b(0) = ratio (s - s(0)): gears, racks, belts.
struct Coupler : Conditional {
  static constexpr std::string_view type = "coupler";
  static constexpr std::string_view doc =
      "Two joint coordinates keep a ratio, as gears, racks and belts do: s_b - s_b(0) = ratio (s - "
      "s(0)).";
  std::string joint, joint_b;
  std::optional<std::string> coordinate, coordinate_b;
  double ratio = 1.0;

  Condition condition() const {
    Condition out;
    out.terms = {{joint_b, {}, coordinate_b, 1.0, "joint_b", "coordinate_b"},
                 {joint, {}, coordinate, -ratio}};
    out.keeps_start = true;
    return out;
  }
  std::string text(const MotionText& motion) const {
    const std::vector<Condition::Term> terms = condition().terms;
    return motion(terms[0]) + " moves " + number_text(ratio) + " x " + motion(terms[1]);
  }
  std::optional<Fault> fault() const {
    if (ratio == 0.0)
      return Fault{"ratio", "ratio must not be zero"};
    return {};
  }

  template <class C = Coupler> static Fields<C> fields() {
    return conditional_fields<C>() +
           Fields<C>{
               {"joint", &C::joint, "-", "Joint whose coordinate is meant.", true},
               coordinate_field<C>(),
               {"joint_b", &C::joint_b, "-", "Second joint of a coupler.", true},
               {"coordinate_b", &C::coordinate_b, "-", "Its coordinate; by default the first."},
               {"ratio", &C::ratio, "- or m/rad",
                "Motion of the second joint per motion of the first."},
           };
  }
};

} // namespace hydrodae::model
