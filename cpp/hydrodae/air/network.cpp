#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/air/network_air.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::air {

namespace {

/// Size of one unit of tolerance, as part of the pressure of the atmosphere.
constexpr double small_pressure = 0.01;

} // namespace

Network::Network(Parts of) : Network(std::move(of), {}, false) {
  for (const Chamber& c : parts_.chambers)
    masses_.push_back(parts_.outside.density * c.volume);
}

Network::Network(Parts of, std::vector<double> masses, bool still)
    : parts_(std::move(of)), masses_(std::move(masses)), still_(still) {
  for (const Piston& p : parts_.pistons)
    chamber_of_.push_back(index_of(parts_.chambers, p.chamber));
  n_states_ = static_cast<int>(parts_.chambers.size());
  for (AnyOutlet& outlet : parts_.outlets)
    add_way(outlet);
  find_rest();
  type = "chamber";
  folder = "chambers";
  absorbs = true;
  tells_unknowns = false;
  names = {parts_.chambers.front().name};
  shape = {element::Port::along_coordinates, static_cast<int>(parts_.pistons.size()),
           still_ ? 0 : n_states_, side_at + n_kinks};
  inputs.resize(static_cast<std::size_t>(shape.n_signals));
  signals.resize(inputs.size(), 0.0);
  if (!still_)
    name_states();
  name_channels();
}

/// Names the states: masses of the air, then speeds of rotors.
void Network::name_states() {
  for (const Chamber& c : parts_.chambers) {
    element::Unknown mass{unknowns.empty() ? "mass" : c.name + "_mass", "kg"};
    mass.start = parts_.outside.density * c.volume;
    mass.scale = mass.start * small_pressure / c.exponent;
    mass.absolute = true;
    unknowns.push_back(mass);
  }
  for (const AnyOutlet& outlet : parts_.outlets)
    outlet.visit([&](const auto& own) {
      if constexpr (requires { own.inertia; })
        if (own.inertia) {
          element::Unknown speed{own.name + "_speed", "rad/s", own.speed, own.speed};
          speed.absolute = true;
          unknowns.push_back(speed);
        }
    });
}

void Network::add_way(AnyOutlet& outlet) {
  Way way;
  way.from = index_of(parts_.chambers, outlet->chamber);
  if (outlet->to)
    way.to = index_of(parts_.chambers, *outlet->to);
  outlet.visit([&](auto& own) {
    if constexpr (requires { own.prepare(); })
      own.prepare();
    if constexpr (requires { own.inertia; })
      if (own.inertia)
        way.rotor = n_states_++;
    if constexpr (requires { own.has_kink(); })
      if (own.has_kink())
        way.kink = n_kinks++;
    if constexpr (requires { own.start_signal(); }) {
      way.signal = side_at++;
      const std::string path = "/outlets/" + own.name + "/" + std::string(own.signal());
      inputs.push_back({texts_.emplace_back(path), own.signal_unit(),
                        own.signal() == "torque" ? -INFINITY : 0.0});
      signals.push_back(own.start_signal());
    }
  });
  ways_.push_back(way);
}

/// Joins chambers by the outlets that are open at rest.
void Network::find_rest() {
  rest_.resize(parts_.chambers.size());
  std::iota(rest_.begin(), rest_.end(), 0);
  for (std::size_t k = 0; k < ways_.size(); ++k) {
    const bool shut = parts_.outlets[k].visit([](const auto& own) {
      if constexpr (requires { own.shut_at_rest(); })
        return own.shut_at_rest();
      return false;
    });
    if (shut)
      continue;
    const int a = rest_[static_cast<std::size_t>(ways_[k].from)];
    const int b = ways_[k].to < 0 ? -1 : rest_[static_cast<std::size_t>(ways_[k].to)];
    std::replace(rest_.begin(), rest_.end(), std::max(a, b), std::min(a, b));
  }
}

void Network::evaluate(double, const double* in, const double* held, double* out) const {
  answer(in, held, out);
}
void Network::evaluate(double, const Dual* in, const double* held, Dual* out) const {
  answer(in, held, out);
}

/// Jacobian by dual numbers, without the rates of the pistons.
void Network::jacobian(double, const double* in, const double* held, double* J) const {
  const int n_in = shape.n_in(), n_out = shape.n_out();
  thread_local std::vector<Dual> x, y;
  x.assign(in, in + n_in);
  y.resize(static_cast<std::size_t>(n_out));
  std::fill_n(J, n_in * n_out, 0.0);
  for (int column = 0; column < n_in; ++column) {
    if (column >= shape.width && column < 2 * shape.width)
      continue;
    x[static_cast<std::size_t>(column)].b = 1.0;
    answer<Dual>(x.data(), held, y.data());
    x[static_cast<std::size_t>(column)].b = 0.0;
    for (int row = 0; row < n_out; ++row)
      J[column * n_out + row] = y[static_cast<std::size_t>(row)].b;
  }
}

void Network::kinks(double, const double* in, const double* held, double* out) const {
  std::vector<Air<double>> air;
  find_air(in, air);
  for (std::size_t k = 0; k < ways_.size(); ++k) {
    if (ways_[k].kink < 0)
      continue;
    const Stream<double> s = stream(k, in, held, air);
    parts_.outlets[k].visit([&](const auto& own) {
      if constexpr (requires { own.has_kink(); })
        out[ways_[k].kink] = own.kink(s.drop, s.in, s.held);
    });
  }
}

/// Network whose closed chambers keep the air that was enclosed.
std::shared_ptr<const element::Elements> Network::started(const double* in) const {
  std::vector<double> masses = masses_;
  for (std::size_t c = 0; c < parts_.chambers.size(); ++c) {
    const Chamber& own = parts_.chambers[c];
    const double room = volume(c, in);
    if (!(room > 0.0))
      throw ModelError("chamber." + own.name + ".volume", "chamber " + in_quotes(own.name) +
                                                              ": no air at the start. " +
                                                              trouble(0, in));
    if (!begun_ || rest_[c] < 0)
      masses[c] = parts_.outside.density * room *
                  std::pow(1.0 + own.pressure / parts_.outside.pressure, 1.0 / own.exponent);
  }
  std::shared_ptr<Network> out(new Network(parts_, masses, false));
  out->begun_ = true;
  for (std::size_t c = 0; c < masses.size(); ++c)
    out->unknowns[c].start = masses[c];
  return out;
}

std::shared_ptr<const element::Elements> Network::statics() const {
  if (still_)
    return nullptr;
  return std::shared_ptr<Network>(new Network(parts_, masses_, true));
}

} // namespace hydrodae::air
