#include "hydrodae/system/regime.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/system/names.h"
#include "hydrodae/system/turning.h"

namespace hydrodae::system {

namespace {

/// Offsets of the multipliers in y = [q | u | z | lambda | mu | sigma].
void set_offsets(Regime& s) {
  s.lambdas.assign(s.system.n_rows, redundant);
  s.mus.assign(s.system.n_rows, redundant);
  std::vector<bool> open(s.system.n_rows, false);
  for (const SwitchData& element : s.switches)
    open[s.couplers[static_cast<std::size_t>(element.coupler)].number] = !s.holds(element);
  s.n_lambda = s.n_mu = 0;
  for_each_row(s, [&](const Row& row, bool) {
    if (!row.dropped && !open[row.number])
      s.lambdas[row.number] = s.lambda0 + s.n_lambda++;
  });
  s.mu0 = s.lambda0 + s.n_lambda;
  for_each_row(s, [&](const Row& row, bool velocity_level) {
    if (s.holds(row) && !velocity_level)
      s.mus[row.number] = s.mu0 + s.n_mu++;
  });
  s.sigma0 = s.mu0 + s.n_mu;
  s.n = s.sigma0 + s.system.n_norms;
  s.algebraic.assign(static_cast<std::size_t>(s.n), true);
  std::fill_n(s.algebraic.begin(), s.lambda0, false);
  for (const StateBlock& block : s.states)
    for (std::size_t k = 0; k < block.unknowns.size(); ++k)
      s.algebraic[static_cast<std::size_t>(block.first) + k] = block.unknowns[k].algebraic;
}

/// Copies into a list without moving it: programs hold pointers to its numbers.
template <class List> void put(const List& from, List& to) {
  if (from.size() != to.size())
    throw Error("the state is of another scene than the run");
  if constexpr (requires { from[0][0]; })
    for (std::size_t k = 0; k < from.size(); ++k)
      put(from[k], to[k]);
  else
    std::copy(from.begin(), from.end(), to.begin());
}

} // namespace

Regime::Regime(const System& s) : system(s) {
  modes.assign(s.switches.size(), Mode::open);
  motion_scale = translation_scale = VectorX::Ones(s.n_groups);
  for (const ElementList& list : elements)
    signals.push_back(list.laws->signals);
  lags.resize(signals.size());
  for (const SwitchData& element : switches)
    static_loads.push_back(element.static_load);
  for (const CouplerData& c : couplers)
    rates.push_back(c.drive.constant);
  nearby = start_turns(s);
  lay_out(*this);
}

Regime::Regime(const System& s, const std::vector<Mode>& given) : Regime(s) {
  for (const SwitchData& element : switches)
    set_mode(*this, element, given[element.number]);
  lay_out(*this);
}

void Regime::set(const Held& from) {
  put(from.modes, modes);
  put(from.signals, signals);
  put(from.lags, lags);
  put(from.static_loads, static_loads);
  put(from.rates, rates);
  put(from.nearby, nearby);
  put(from.motion_scale, motion_scale);
  put(from.translation_scale, translation_scale);
}

std::array<double, 3> Regime::drive(const CouplerData& c, double t) const {
  std::array<double, 3> f = c.drive(t);
  if (c.velocity_level)
    f[0] += rates[static_cast<std::size_t>(&c - couplers.data())] - c.drive.constant;
  return f;
}

void lay_out(Regime& s) {
  set_offsets(s);
  set_scales(s);
  set_names(s);
}

void set_mode(Regime& s, const SwitchData& element, Regime::Mode mode) {
  using Mode = Regime::Mode;
  s.modes[element.number] = mode;
  if (element.kind == SwitchData::Kind::stop)
    return;
  s.signals[static_cast<std::size_t>(element.list)][static_cast<std::size_t>(element.law)] =
      mode == Mode::forward    ? -element.kinetic_load
      : mode == Mode::backward ? element.kinetic_load
                               : 0.0;
}

void resize(const Regime& s, VectorX& y) {
  const VectorX head = y.head(s.lambda0);
  y.setZero(s.n);
  y.head(s.lambda0) = head;
}

VectorX initial_state(const Regime& s) {
  VectorX y = VectorX::Zero(s.n);
  for (const BodyData& b : s.bodies) {
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[k];
      y[b.u0 + k] = c < 3 ? b.velocity[c] : b.angular_velocity[c - 3];
      if (c < 3)
        y[b.q0 + k] = b.position[c];
    }
    const Index q = b.q0 + b.n_translations;
    if (b.rotation == BodyData::Rotation::about_axis)
      y[q] = 2.0 * std::atan2(b.orientation[1 + b.axis], b.orientation[0]);
    if (b.rotation == BodyData::Rotation::free)
      y.segment<4>(q) = b.orientation;
  }
  for (const StateBlock& block : s.states)
    for (std::size_t k = 0; k < block.unknowns.size(); ++k)
      y[block.first + static_cast<Index>(k)] = block.unknowns[k].start;
  return y;
}

} // namespace hydrodae::system
