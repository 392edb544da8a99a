#include <algorithm>

#include "hydrodae/build/parts.h"

namespace hydrodae::build {

void add_gauges(const model::Scene& scene, const Sea& sea, system::System& s) {
  for (const sea::Gauge& gauge : scene.gauges) {
    system::GaugeData out;
    out.name = gauge.name;
    out.ahead = gauge.ahead;
    if (!gauge.point.empty()) {
      out.x = gauge.point[0];
      out.y = gauge.point[1];
    }
    if (gauge.marker)
      out.marker = static_cast<int>(
          std::find_if(s.markers.begin(), s.markers.end(),
                       [&](const system::MarkerData& m) { return m.name == *gauge.marker; }) -
          s.markers.begin());
    s.gauges.push_back(std::move(out));
  }
  if (!scene.gauges.empty())
    s.gauged = sea.field;
  if (sea.second) {
    s.gauged.terms.keep(sea.all.size()); // all bound waves, in place of the largest
    s.gauged.second = sea.second;
  }
  if (!sea.note.empty())
    s.notes.push_back(sea.note);
}

} // namespace hydrodae::build
