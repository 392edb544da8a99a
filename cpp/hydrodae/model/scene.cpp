#include "hydrodae/model/forces.h"

#include "hydrodae/joint/types.h"

namespace hydrodae::model {

Scene::Scene() = default;
Scene::~Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

template <class Force> const std::vector<Force>& forces_of(const Scene& scene) {
  return std::get<std::vector<Force>>(scene.forces->lists);
}
template const std::vector<element::DryFriction>& forces_of(const Scene&);
template const std::vector<element::PtoLinear>& forces_of(const Scene&);
template const std::vector<line::CatenaryLine>& forces_of(const Scene&);
template const std::vector<line::Line>& forces_of(const Scene&);
template const std::vector<line::Rope>& forces_of(const Scene&);

std::vector<std::string> force_names(const Scene& scene) {
  std::vector<std::string> out;
  for_each_force(scene, [&](const auto& force) { out.push_back(force.name); });
  return out;
}

Fields<Joint> Joint::fields() {
  using J = Joint;
  return {
      {"name", &J::name, "-", "Name of the joint.", true},
      {"type", &J::type, "-", "Kind of joint.", true, any_value, joint::joint_type_names()},
      {"body_a", &J::body_a, "-", "Body that carries the first marker, or ground.", true},
      {"body_b", &J::body_b, "-", "Body that carries the second marker, or ground.", true},
      {"point", &J::point, "m", "Where the joint is in the reference pose, world axes.", true},
      {"axis", &J::axis, "-",
       "Direction of the axis in the reference pose, world axes: z of both markers."},
      {"axis_x", &J::axis_x, "-",
       "Direction across the axis that is x of both markers (made perpendicular to the axis)."},
      {"point_b", &J::point_b, "m",
       "Point on body B in the reference pose, world axes; distance joint only."},
      {"length", &J::length, "m",
       "Distance that is kept; default: that of point and point_b. Distance joint only.", false,
       more_than(0)},
      {"pitch", &J::pitch, "m per turn",
       "Advance of body B along the axis for one turn about it, not zero; screw joint only."},
      {"path", &J::path, "m",
       "Points of the curve that body A carries, in the reference pose, world axes. A natural "
       "cubic spline joins them and continues straight beyond its ends; path joint only."},
      {"one_sided", &J::one_sided, "-",
       "The points may come nearer than `length`, as on a taut or slack rope; distance joint "
       "only."},
      {"restitution", &J::restitution, "-",
       "Rate of the distance after a one-sided joint becomes taut over the rate before; 0, the "
       "default: no rebound.",
       false, between(0, 1)},
      {"contact_time", &J::contact_time, "s",
       "How long an impact of a one-sided joint is taken to last, for its peak force; see that of "
       "a stop.",
       false, more_than(0)},
  };
}

Water water(const Scene& scene) {
  if (scene.database)
    return {scene.database->rho, scene.database->water_depth, scene.database->gravity};
  const Environment& e = scene.environment;
  return {e.water_density.value_or(0.0), e.water_depth.value_or(INFINITY),
          e.gravity.value_or(Water{}.gravity)};
}

CaseError located(const Scene& scene, const ModelError& error) {
  std::string key = error.key;
  while (true) {
    const auto found = scene.places.find(key);
    if (found != scene.places.end())
      return {found->second, error.key, error.what()};
    const std::size_t dot = key.rfind('.');
    if (dot == std::string::npos)
      break;
    key.resize(dot);
  }
  return {{scene.path}, error.key, error.what()};
}

} // namespace hydrodae::model
