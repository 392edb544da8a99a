/// Findings on meshes in still water: their size and freeboard.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/sanity/sanity.h"

namespace hydrodae::sanity {

namespace {

/// Longest plausible hull [m]; the longest ship was 488 m long
constexpr double longest_hull = 1000.0;
constexpr double length_slip = 100.0; ///< ratio of two lengths that suggests a wrong unit
constexpr double digits = 1e-3;       ///< rounding of a file, as part of the height of a hull

/// Bounding box of the mesh of a body in its reference pose, world axes [m].
struct Extent {
  Vector3 low, high;
  double length() const { return (high - low).maxCoeff(); }
};

Extent extent_of(const model::Body& body) {
  const hull::Columns& v = body.hull->vertices;
  return {body.center_of_gravity + v.colwise().minCoeff().matrix().transpose(),
          body.center_of_gravity + v.colwise().maxCoeff().matrix().transpose()};
}

/// Height of the largest of a thousand crests [m]: a quarter of the significant height times
/// sqrt(2 ln 1000) (Longuet-Higgins 1952), half of each regular wave, and crests that are given.
double highest_crest(const model::Scene& scene) {
  double regular = 0.0, squares = 0.0, given = 0.0;
  for (const sea::Wave& wave : scene.waves)
    wave.visit([&](const auto& one) {
      if constexpr (requires { one.crest; })
        given = std::max(given, one.crest.height);
      if constexpr (requires { one.significant_height(); })
        squares += std::pow(one.significant_height(), 2);
      else if constexpr (requires { one.height; })
        regular += 0.5 * one.height;
    });
  return regular + std::max(given, 0.25 * std::sqrt(2.0 * std::log(1000.0) * squares));
}

std::string metres(double length) { return rounded_text(length, 3) + " m"; }

void judge_size(const model::Scene& scene, const model::Body& body, const Extent& extent,
                std::vector<Finding>& out) {
  const std::string mesh = "the mesh of body " + in_quotes(body.name),
                    remedy = "; is it in metres? 'hydrodae hdb hull FILE --scale 0.001' converts "
                             "millimetres";
  const double length = extent.length(), depth = model::water(scene).depth;
  if (length > longest_hull)
    out.push_back({true, mesh + " is " + metres(length) + " long and encloses " +
                             rounded_text(body.hull->volume, 3) +
                             " m3; no hull is longer than 500 m" + remedy});
  if (extent.low[2] < -depth)
    out.push_back({true, mesh + " reaches down to z = " + metres(extent.low[2]) +
                             ", below the sea bed at " + metres(-depth) +
                             "; mesh_origin is its place in the reference pose"});
  for (const model::Body& other : scene.bodies)
    if (other.hull && length > length_slip * extent_of(other).length())
      out.push_back({true, mesh + " is " + metres(length) + " long, that of body " +
                               in_quotes(other.name) + " " + metres(extent_of(other).length()) +
                               remedy});
}

void judge_freeboard(const model::Body& body, const Extent& extent, double crest,
                     std::vector<Finding>& out) {
  const double freeboard = extent.high[2], height = freeboard - extent.low[2];
  const std::array<bool, 6> free = model::free_coordinates(body);
  const bool heaves = free[2], moves = std::count(free.begin(), free.end(), true) > 0;
  if (freeboard < -digits * height || !(crest > 0.0 || moves))
    return; // below the water, or at rest in still water
  const std::string text = "the mesh of body " + in_quotes(body.name);
  if (freeboard <= digits * height) {
    out.push_back({true, text + " ends at the still water line: without freeboard its buoyancy "
                                "does not grow when it sinks; mesh the hull up to its deck"});
    return;
  }
  const double swing = heaves ? std::abs(body.initial.displacement[2]) : 0.0;
  if (freeboard < crest + swing)
    out.push_back({false, text + " ends " + metres(freeboard) +
                              " above still water; waves of up "
                              "to " +
                              metres(crest) + " and a start " + metres(swing) +
                              " from rest may flood its deck, whose water counts by its "
                              "pressure alone"});
}

} // namespace

std::vector<Finding> look_at_hulls(const model::Scene& scene) {
  std::vector<Finding> out;
  const double crest = highest_crest(scene);
  for (const model::Body& body : scene.bodies) {
    if (!body.hull)
      continue;
    const Extent extent = extent_of(body);
    judge_size(scene, body, extent, out);
    judge_freeboard(body, extent, crest, out);
  }
  return out;
}

} // namespace hydrodae::sanity
