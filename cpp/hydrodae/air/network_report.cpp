/// Reports of a network: channels, stored energy, and reasons for missing results.

#include <cmath>

#include "hydrodae/air/network_air.h"
#include "hydrodae/core/text.h"

namespace hydrodae::air {

namespace {

constexpr std::size_t values_of_chamber = 4, values_of_outlet = 3, values_of_turbine = 7;

} // namespace

void Network::name_channels() {
  const auto add = [&](const std::string& path, std::string_view unit, std::string_view doc) {
    channels.push_back({texts_.emplace_back("/" + path), unit, doc});
  };
  for (const Chamber& c : parts_.chambers) {
    const std::string head = "chambers/" + c.name + "/";
    add(head + "pressure", "Pa", "Gauge pressure of the air.");
    add(head + "volume", "m3", "Volume of the air.");
    add(head + "mass", "kg", "Mass of the air.");
    add(head + "energy", "J", "Energy that the air has stored against the atmosphere.");
  }
  for (const AnyOutlet& outlet : parts_.outlets) {
    const std::string head = "outlets/" + outlet->name + "/";
    add(head + "mass_flow", "kg/s", "Mass flow out of its chamber.");
    add(head + "pressure_drop", "Pa", "Drop of pressure, from its chamber to where it leads.");
    add(head + "power", "W", "Power that the flow gives to it: mass flow times drop of enthalpy.");
    outlet.visit([&](const auto& own) {
      if constexpr (requires { own.eta; }) {
        add(head + "psi", "-", "Dimensionless pressure Psi of the turbine.");
        add(head + "rotor_speed", "rad/s", "Speed of rotation.");
        add(head + "rotor_energy", "J", "Kinetic energy of the rotor; zero without inertia.");
        add(head + "power_pneumatic", "W", "Drop of pressure times volume flow at the inlet.");
        add(head + "power_turbine", "W", "Power that the turbine takes out of the air.");
        add(head + "power_shaft", "W", "Power that the generator takes from the shaft.");
        add(head + "power_electric", "W", "Power of the generator.");
      }
    });
  }
}

/// Enthalpy h - h_a = n / (n - 1) p_a / rho_a ((p / p_a)^((n - 1) / n) - 1) [J/kg], p absolute.
double Network::heat(int chamber, const std::vector<Air<double>>& air) const {
  if (chamber < 0)
    return 0.0;
  const auto c = static_cast<std::size_t>(chamber);
  const Atmosphere& a = parts_.outside;
  const double n = parts_.chambers[c].exponent, r = std::log1p(air[c].gauge / a.pressure);
  const double scaled = n == 1.0 ? r : n / (n - 1.0) * std::expm1((n - 1.0) / n * r);
  return a.pressure / a.density * scaled;
}

namespace {

/// Stored energy E / M = p_a / rho_a ((e^((n - 1) r / n) - 1) / (n - 1) + e^(-r / n) - 1), r =
/// log(p / p_a)
/// [J/kg]
double stored(const Atmosphere& a, double n, double gauge) {
  const double r = std::log1p(gauge / a.pressure);
  const double heated = n == 1.0 ? r : std::expm1((n - 1.0) / n * r) / (n - 1.0);
  return a.pressure / a.density * (heated + std::expm1(-r / n));
}

} // namespace

void Network::energy(const double* in, const double*, double* joules) const {
  std::vector<Air<double>> air;
  find_air(in, air);
  *joules = 0.0;
  for (std::size_t c = 0; c < air.size(); ++c)
    *joules += air[c].mass * stored(parts_.outside, parts_.chambers[c].exponent, air[c].gauge);
}

void Network::observe(double, const double* in, const double* held, const double*,
                      double* values) const {
  std::vector<Air<double>> air;
  find_air(in, air);
  for (std::size_t c = 0; c < air.size(); ++c, values += values_of_chamber) {
    values[0] = air[c].gauge;
    values[1] = air[c].volume;
    values[2] = air[c].mass;
    values[3] = air[c].mass * stored(parts_.outside, parts_.chambers[c].exponent, air[c].gauge);
  }
  for (std::size_t k = 0; k < ways_.size(); ++k, values += values_of_outlet) {
    const Stream<double> s = stream(k, in, held, air);
    values[0] = s.flow;
    values[1] = s.drop;
    values[2] = s.flow * (heat(ways_[k].from, air) - heat(ways_[k].to, air));
    const bool turns =
        parts_.outlets[k].visit([](const auto& own) { return requires { own.eta; }; });
    if (turns) {
      observe_turbine(k, s, values + values_of_outlet);
      values += values_of_turbine;
    }
  }
}

/// Channels of a turbine. At constant speed the generator takes all its torque.
void Network::observe_turbine(std::size_t outlet, const Stream<double>& s, double* values) const {
  parts_.outlets[outlet].visit([&](const auto& own) {
    if constexpr (requires { own.eta; }) {
      const double w = s.in.speed;
      values[0] = own.psi(s.drop, s.in);
      values[1] = w;
      values[2] = own.inertia ? 0.5 * *own.inertia * w * w : 0.0;
      values[3] = s.drop * s.flow / s.in.density;
      values[4] = own.power(s.drop, s.flow, s.in);
      values[5] = own.inertia ? own.generator_torque(w, s.held) * w : values[4];
      values[6] = own.generator_efficiency * values[5];
    }
  });
}

std::string Network::trouble(std::size_t, const double* in) const {
  for (std::size_t k = 0; k < parts_.pistons.size(); ++k) {
    const Piston& p = parts_.pistons[k];
    if (p.roof && !(in[k] < *p.roof))
      return "piston " + in_quotes(p.name) + " of chamber " + in_quotes(p.chamber) +
             " is at the roof, at " + rounded_text(in[k], 4) +
             " m: water in the air duct is beyond this model; stop the piston below by an "
             "end_stop, "
             "or give a higher 'roof'";
  }
  for (std::size_t c = 0; c < parts_.chambers.size(); ++c)
    if (const double left = room_left(c, in); !(left > 0.0))
      return "no air is left in chamber " + in_quotes(parts_.chambers[c].name) +
             ", whose volume is now " + rounded_text(left, 4) +
             " m3: give a larger 'volume', or stop its pistons by an end_stop";
  for (std::size_t k = 0; k < ways_.size(); ++k)
    if (ways_[k].rotor >= 0 && !still_ && !(in[2 * shape.width + ways_[k].rotor] > 0.0))
      return "the rotor of " + in_quotes(parts_.outlets[k]->name) +
             " stands still, and its law divides by its speed: give it less torque";
  std::vector<Air<double>> air;
  find_air(in, air);
  for (std::size_t k = 0; k < ways_.size(); ++k)
    if (!std::isfinite(stream(k, in, nullptr, air).flow))
      return "outlet " + in_quotes(parts_.outlets[k]->name) +
             " is beyond its data: give 'efficiency_at' (and 'flow_at') up to a larger Psi, or "
             "limit "
             "the pressure by a valve";
  return {};
}

} // namespace hydrodae::air
