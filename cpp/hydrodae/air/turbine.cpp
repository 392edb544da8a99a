#include "hydrodae/air/turbine.h"

namespace hydrodae::air {

namespace {

std::optional<Fault> points_fault(const std::string& at, const std::vector<double>& x,
                                  const std::string& of, const std::vector<double>& y) {
  if (const std::string_view wrong = Curve::fault(x, y); !wrong.empty())
    return Fault{of, std::string(wrong) + " '" + at + "'"};
  return {};
}

} // namespace

std::optional<Fault> Turbine::fault() const {
  if (const auto wrong = points_fault("efficiency_at", efficiency_at, "efficiency", efficiency))
    return wrong;
  if (const auto wrong = points_fault("torque_at", torque_at, "torque_load", torque_load))
    return wrong;
  if (!efficiency_at.empty() && efficiency_at.front() != 0.0)
    return Fault{"efficiency_at", "must begin with 0, which the pressure crosses"};
  if (!torque_load.empty() && torque > 0.0)
    return Fault{"torque", "'torque_load' gives the torque of the generator already"};
  if (!inertia && (windage > 0.0 || torque > 0.0 || !torque_load.empty()))
    return Fault{windage > 0.0  ? "windage"
                 : torque > 0.0 ? "torque"
                                : "torque_load",
                 "needs 'inertia': without it the speed stays, whatever brakes the rotor"};
  if (inertia && efficiency.empty())
    return Fault{"inertia", "needs 'efficiency_at' and 'efficiency', which drive the rotor"};
  return {};
}

} // namespace hydrodae::air
