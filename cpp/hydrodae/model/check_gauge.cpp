#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

/// Checks a forecast; a record has no data after its end.
void check_forecast(const Scene& scene, const Entry& entry, const sea::Gauge& gauge) {
  if (gauge.ahead.empty())
    return;
  const double ahead = *std::max_element(gauge.ahead.begin(), gauge.ahead.end());
  for (const sea::Wave& any : scene.waves) {
    const auto* wave = any.as<sea::Measured>();
    if (!wave)
      continue;
    const double length = wave->length();
    const double last = wave->start + scene.solver.end_time + ahead;
    if (last > length * (1.0 + 1e-12))
      refuse(entry, "ahead",
             "the record of wave " + in_quotes(wave->name) + " is " + number_text(length) +
                 " s long; 'ahead' = " + number_text(ahead) + " s needs it until " +
                 number_text(last) + " s at the end of the run (solver.end_time)");
  }
}

} // namespace

void check_gauge(const Scene& scene, const sea::Gauge& gauge) {
  const Entry entry{"gauge", gauge.name};
  if (scene.waves.empty())
    refuse(entry, "", "there is no [[wave]] whose elevation it could measure");
  if (!gauge.point.empty() && gauge.point.size() != 2)
    refuse(entry, "point", "expected 'point' = [x, y], its place [m]");
  constexpr double far = 1e7; // distance [m] at which waves of 60 m have a phase error of 1e-9
  for (const double x : gauge.point)
    if (std::abs(x) > far)
      refuse(entry, "point",
             "expected 'point' within 1e7 m of the origin, got " + number_text(x) +
                 " m: the phases of waves are lost there");
  if (gauge.marker && !gauge.point.empty())
    refuse(entry, "marker", "give either 'point' or 'marker'");
  if (gauge.marker)
    check_reference(entry, "marker", *gauge.marker, names_of(scene.markers), "marker");
  check_forecast(scene, entry, gauge);
}

} // namespace hydrodae::model
