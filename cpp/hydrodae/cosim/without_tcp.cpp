/// Built in place of TCP where HYDRODAE_TCP is off.

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/tcp.h"

namespace hydrodae::cosim {

void join_tcp(model::Scene& scene) {
  for (const model::Controller& c : scene.controllers)
    if (c.as<control::Tcp>())
      throw ModelError("controller." + c->name + ".type",
                       "controller " + in_quotes(c->name) +
                           ": this build of hydrodae has no TCP; build it with -DHYDRODAE_TCP=ON");
}

} // namespace hydrodae::cosim
