/// Built in place of FMUs where HYDRODAE_FMU is off.

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu.h"

namespace hydrodae::cosim {

namespace {

[[noreturn]] void refuse(const std::string& name) {
  throw ModelError("controller." + name + ".type",
                   "controller " + in_quotes(name) +
                       ": this build of hydrodae takes no FMU; build it with -DHYDRODAE_FMU=ON");
}

} // namespace

void join_fmus(model::Scene& scene) { require_fmu_states(scene); }

std::vector<std::string> check_fmu(const control::Fmu& controller, const control::Terminals&) {
  refuse(controller.name);
}

void require_fmu_states(const model::Scene& scene) {
  for (const model::Controller& c : scene.controllers)
    if (c.as<control::Fmu>())
      refuse(c->name);
}

} // namespace hydrodae::cosim
