#pragma once
#include "hydrodae/air/turbine.h"

namespace hydrodae::air {

/// Turbine with measured points of Phi over Psi, equal in both directions.
struct MeasuredTurbine : Turbine {
  static constexpr std::string_view type = "turbine";
  static constexpr std::string_view doc =
      "A turbine by measured points: dimensionless flow over dimensionless pressure.";
  std::vector<double> flow_at, flow_values;
  Curve phi;

  void prepare() {
    Turbine::prepare();
    phi = Curve(flow_at, flow_values);
  }
  template <class S> bool reaches(const S& drop, const Inlet<S>& in) const {
    using std::abs;
    return Turbine::reaches(drop, in) && abs(psi(drop, in)) <= S(flow_at.back());
  }
  template <class S> S flow(const S& drop, const Inlet<S>& in, const Held&) const {
    using std::abs;
    const S at = psi(drop, in), size = abs(at);
    return mass_flow(S(at < S(0) ? -phi(size) : phi(size)), in);
  }

  std::optional<Fault> fault() const {
    if (const std::string_view wrong = Curve::fault(flow_at, flow_values); !wrong.empty())
      return Fault{"flow", std::string(wrong) + " 'flow_at'"};
    if (flow_at.front() != 0.0 || flow_values.front() != 0.0)
      return Fault{"flow_at", "and 'flow' must begin with 0: without a drop there is no flow"};
    for (std::size_t i = 1; i < flow_values.size(); ++i)
      if (!(flow_values[i] > flow_values[i - 1]))
        return Fault{"flow", "must ascend with the pressure"};
    return Turbine::fault();
  }

  template <class O = MeasuredTurbine> static Fields<O> fields() {
    return turbine_fields<O>() +
           Fields<O>{
               {"flow_at", &O::flow_at, "-", "Dimensionless pressures |Psi|, from 0 on.", true,
                at_least(0)},
               {"flow", &O::flow_values, "-", "Dimensionless flow |Phi| at these, from 0 on.", true,
                at_least(0)},
           };
  }
};

} // namespace hydrodae::air
