#include "hydrodae/run/impacts.h"

namespace hydrodae::run {

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

} // namespace hydrodae::run
