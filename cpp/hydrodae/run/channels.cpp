#include "hydrodae/run/channels.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/run/controllers.h"

namespace hydrodae::run {

namespace {

/// Columns of the solver.
const std::vector<Channel> solver_channels = {
    {"solver/step", 1, "s", "-", "Length of the step that holds this sample."},
    {"solver/order", 1, "-", "-", "Order of that step."}};

} // namespace

ImpactOutput::ImpactOutput(const system::System& s) {
  for (std::size_t k = 0; k < s.switches.size(); ++k) {
    const system::SwitchData& element = s.switches[k];
    if (element.kind == system::SwitchData::Kind::stop)
      stops_.push_back({k, s.couplers[static_cast<std::size_t>(element.coupler)].name,
                        s.motions[static_cast<std::size_t>(element.motion)].motion.is_angle(),
                        element.contact_time});
  }
}

std::vector<Channel> ImpactOutput::channels() const {
  std::vector<Channel> out;
  for (const Stop& stop : stops_) {
    const std::string head = "constraints/" + stop.name + "/";
    out.push_back({head + "impulse", 1, stop.angle ? "N m s" : "N s", "-",
                   "Sum of the impulses of all impacts so far; group impacts has each."});
    out.push_back({head + "energy_lost", 1, "J", "-",
                   "Sum of the energies that all impacts so far have taken."});
  }
  return out;
}

void ImpactOutput::fill(const events::Switching* switching, double* at) const {
  for (const Stop& stop : stops_) {
    *at++ = switching->struck()[stop.index].impulse;
    *at++ = switching->struck()[stop.index].energy_lost;
  }
}

Channels::Channels(const system::Regime& regime, measure::Measure& measure,
                   const std::vector<Channel>& held)
    : recorder_(regime, measure), impacts_(regime.system), all_(recorder_.channels()),
      width_(recorder_.width()) {
  add(solver_channels);
  add(impacts_.channels());
  add(held);
}

void Channels::add(const std::vector<Channel>& more) {
  all_.insert(all_.end(), more.begin(), more.end());
  for (const Channel& c : more)
    width_ += static_cast<std::size_t>(c.width);
}

void Channels::fill(const Counts& counts, std::span<double> row) const {
  double* out = row.data() + recorder_.width();
  *out++ = counts.last.last_step;
  *out++ = counts.last.last_order;
  impacts_.fill(counts.switching, out);
  std::copy(counts.held.begin(), counts.held.end(), out + impacts_.width());
}

std::span<const double> Channels::find(const std::string& name, std::span<const double> row) const {
  std::size_t column = 0;
  std::vector<std::string> names;
  for (const Channel& c : all_) {
    if (c.path == name)
      return row.subspan(column, static_cast<std::size_t>(c.width));
    column += static_cast<std::size_t>(c.width);
    names.push_back(c.path);
  }
  if (name.rfind('.') != std::string::npos)
    return row.subspan(find_column(all_, name), 1);
  throw CaseError("there is no channel " + in_quotes(name) + suggestion(name, names));
}

} // namespace hydrodae::run
