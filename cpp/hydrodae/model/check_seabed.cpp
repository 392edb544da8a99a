#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/line/line.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {

std::shared_ptr<const SmoothTable> Seabed::surface() const {
  const Eigen::Map<const MatrixX> depths(depth.data(), static_cast<Index>(x.size()),
                                         static_cast<Index>(y.size()));
  return std::make_shared<const SmoothTable>(x, y, -depths);
}

std::optional<Fault> Seabed::fault() const {
  for (const auto& [key, values] : {std::pair{"x", &x}, std::pair{"y", &y}}) {
    if (values->size() < 2)
      return Fault{key, "two places at least are needed"};
    const auto wrong = std::adjacent_find(values->begin(), values->end(), std::greater_equal<>());
    if (wrong != values->end())
      return Fault{key, "the places must rise: " + number_text(*wrong) + " m, then " +
                            number_text(*(wrong + 1)) + " m"};
  }
  if (depth.size() != x.size() * y.size())
    return Fault{"depth", "expected " + std::to_string(x.size() * y.size()) +
                              " depths, one for each of " + std::to_string(x.size()) +
                              " 'x' in each of " + std::to_string(y.size()) + " rows of 'y'; got " +
                              std::to_string(depth.size())};
  return {};
}

void check_seabed(const Scene& scene) {
  if (!scene.seabed)
    return;
  if (const std::optional<Fault> wrong = scene.seabed->fault())
    throw ModelError("seabed." + wrong->key, "seabed: " + wrong->message);
  const auto& lines = forces_of<line::Line>(scene);
  if (std::none_of(lines.begin(), lines.end(), [](const line::Line& l) { return l.seabed; }))
    throw ModelError("seabed", "this seabed is for forces of type 'line', and the case lacks one "
                               "that lies on it; a 'catenary' has a flat seabed");
}

} // namespace hydrodae::model
