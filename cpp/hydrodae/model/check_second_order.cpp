#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {

void check_second_order(const Scene& scene) {
  if (!scene.second_order)
    return;
  const SecondOrder& own = *scene.second_order;
  const std::string key = "second_order.loads";
  if (!scene.hydro)
    throw ModelError("second_order", "[second_order] takes its tables from the hydrodynamic "
                                     "database: the table [hydro] is missing");
  if (scene.waves.empty())
    throw ModelError("second_order",
                     "[second_order] is about pairs of waves, and the case has no [[wave]]");
  const auto slow = std::count_if(own.loads.begin(), own.loads.end(),
                                  [](const std::string& load) { return load != "sum"; });
  if (own.loads.empty() || slow > 1 || std::ssize(own.loads) - slow > 1)
    throw ModelError(key, "expected one of \"mean\", \"newman\" and \"difference\", each of which "
                          "holds the mean drift, with or without \"sum\": loads = "
                          "[\"difference\", \"sum\"]");
}

} // namespace hydrodae::model
