#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {

void check_marker(const Scene& scene, const Marker& marker) {
  const Entry entry{"marker", marker.name};
  check_reference(entry, "body", marker.body, names_of_bodies(scene), "body");
  if (!moves(*find_named(scene.bodies, marker.body)))
    refuse(entry, "body", "body " + in_quotes(marker.body) + " is fixed: its points do not move");
  check_reference(entry, "axes", marker.axes, {"world", "body"}, "axes");
}

} // namespace hydrodae::model
