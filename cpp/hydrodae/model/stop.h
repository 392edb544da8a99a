#pragma once
#include "hydrodae/core/text.h"
#include "hydrodae/model/condition.h"

namespace hydrodae::model {

/// Stop, lower <= s <= upper, with impacts: s' after = -restitution s' before.
struct Stop : Conditional {
  static constexpr std::string_view type = "stop";
  static constexpr std::string_view doc = "A joint coordinate stays within bounds, with impacts.";
  std::string joint;
  std::optional<std::string> coordinate;
  std::optional<double> lower, upper, lower_angle, upper_angle, restitution, contact_time;

  Condition condition() const {
    Condition out;
    out.terms = {{joint, {}, coordinate}};
    out.bounds = {lower ? *lower : lower_angle.value_or(-INFINITY),
                  upper ? *upper : upper_angle.value_or(INFINITY), restitution.value_or(0.0),
                  contact_time};
    return out;
  }
  std::string text(const MotionText& motion) const {
    const auto bound = [](const char* word, const std::optional<double>& length,
                          const std::optional<double>& angle) {
      return length  ? word + number_text(*length) + " m"
             : angle ? word + number_text(*angle * 180.0 / pi) + " deg"
                     : std::string();
    };
    return motion(condition().terms[0]) + " stays" + bound(" above ", lower, lower_angle) +
           bound(" below ", upper, upper_angle) + ", restitution " +
           number_text(restitution.value_or(0.0));
  }
  std::optional<Fault> fault() const {
    const Condition::Bounds b = *condition().bounds;
    if (!std::isfinite(b.lower) && !std::isfinite(b.upper))
      return Fault{"", "a stop needs one of the keys 'lower', 'upper', 'lower_deg', 'upper_deg'"};
    if (!(b.lower < b.upper))
      return Fault{upper ? "upper" : "upper_deg", "the upper bound must be above the lower one"};
    return {};
  }

  template <class C = Stop> static Fields<C> fields() {
    return conditional_fields<C>() +
           Fields<C>{
               {"joint", &C::joint, "-", "Joint whose coordinate is meant.", true},
               coordinate_field<C>(),
               {"lower", &C::lower, "m", "Least displacement that a stop allows."},
               {"upper", &C::upper, "m", "Largest displacement that a stop allows."},
               {"lower_deg", &C::lower_angle, "deg", "Least angle that a stop allows."},
               {"upper_deg", &C::upper_angle, "deg", "Largest angle that a stop allows."},
               {"restitution", &C::restitution, "-",
                "Rate after an impact over the rate before; 0, the default: no rebound.", false,
                between(0, 1)},
               {"contact_time", &C::contact_time, "s",
                "How long an impact is taken to last: half a sine of this length has the impulse J "
                "at a peak force of pi J / (2 contact_time), which the results then list. The "
                "motion does not know of it.",
                false, more_than(0)},
           };
  }
};

} // namespace hydrodae::model
