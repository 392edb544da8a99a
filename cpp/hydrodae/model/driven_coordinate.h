#pragma once
#include "hydrodae/model/condition.h"

namespace hydrodae::model {

/// Driven coordinate, s = f(t) (level position) or s' = f(t) (level velocity).
struct DrivenCoordinate : Conditional {
  static constexpr std::string_view type = "coordinate";
  static constexpr std::string_view doc =
      "One coordinate of a joint or a body follows a function of time.";
  std::optional<std::string> joint, body, coordinate;
  std::string level = "position";
  Drive drive;

  Condition condition() const {
    Condition out;
    out.terms = {{joint, body, coordinate}};
    out.drive = drive;
    out.velocity_level = level == "velocity";
    return out;
  }
  std::string text(const MotionText& motion) const {
    const bool steady = !drive.moves() && drive.rate == 0.0 && !drive.python && drive.time.empty();
    return (level == "velocity" ? "rate of " : "") + motion(condition().terms[0]) +
           (steady ? " stays " : " follows ") + drive.text();
  }
  std::optional<Fault> fault() const {
    if (!joint && !body)
      return Fault{"", "needs the key 'joint' or 'body' that has the coordinate"};
    if (joint && body)
      return Fault{"body", "has both 'joint' and 'body'; a coordinate belongs to one of them"};
    return {};
  }

  template <class C = DrivenCoordinate> static Fields<C> fields() {
    return conditional_fields<C>() +
           Fields<C>{
               {"joint", &C::joint, "-", "Joint whose coordinate is meant."},
               {"body", &C::body, "-",
                "Body whose coordinate is meant (relative to its reference pose)."},
               coordinate_field<C>(),
               {"level",
                &C::level,
                "-",
                "What follows the function: the coordinate or its rate.",
                false,
                any_value,
                {"position", "velocity"}},
           };
  }
};

} // namespace hydrodae::model
