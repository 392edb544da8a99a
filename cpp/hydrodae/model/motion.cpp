#include "hydrodae/model/motion.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/deformation.h"

namespace hydrodae::model {
namespace {

using Six = std::array<bool, 6>;

struct MotionWord {
  std::string_view word;
  Six free;
};
constexpr std::array<MotionWord, 4> whole_motions = {{
    {"fixed", {false, false, false, false, false, false}},
    {"planar", {true, false, true, false, true, false}},
    {"point", {true, true, true, false, false, false}},
    {"rigid", {true, true, true, true, true, true}},
}};

[[noreturn]] void refuse_motion(const Body& body, const std::string& message) {
  throw ModelError("body." + body.name + ".motion",
                   "body " + in_quotes(body.name) + ": " + message);
}

void add_word(const Body& body, const std::string& word, Six& free) {
  for (const MotionWord& motion : whole_motions) {
    if (motion.word != word)
      continue;
    if (body.motion.size() > 1)
      refuse_motion(body, "motion " + in_quotes(word) +
                              " stands alone; a list holds coordinates (" +
                              joined(coordinate_names) + ")");
    free = motion.free;
    return;
  }
  const auto found = std::find(coordinate_names.begin(), coordinate_names.end(), word);
  if (found == coordinate_names.end()) {
    std::vector<std::string> valid(coordinate_names.begin(), coordinate_names.end());
    for (const MotionWord& motion : whole_motions)
      valid.emplace_back(motion.word);
    refuse_motion(body, "unknown motion " + in_quotes(word) + suggestion(word, valid));
  }
  bool& coordinate = free[static_cast<std::size_t>(found - coordinate_names.begin())];
  if (coordinate)
    refuse_motion(body, "motion names " + in_quotes(word) + " twice");
  coordinate = true;
}

} // namespace

std::array<bool, 6> free_coordinates(const Body& body) {
  if (body.motion.empty())
    refuse_motion(body, "motion is empty; a body that stays is 'fixed'");
  Six free{};
  for (const std::string& word : body.motion)
    add_word(body, word, free);
  if (std::count(free.begin() + 3, free.end(), true) == 2)
    refuse_motion(
        body, "motion frees two of roll, pitch and yaw; possible are one rotation or all three");
  return free;
}

std::array<bool, 6> moving_axes(const Body& body) {
  Six moving = free_coordinates(body);
  const bool translates = moving[0] || moving[1] || moving[2];
  const auto rotations = std::count(moving.begin() + 3, moving.end(), true);
  if (rotations == 1) {
    const auto axis = static_cast<std::size_t>(std::find(moving.begin() + 3, moving.end(), true) -
                                               moving.begin() - 3);
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    moving[i] = moving[j] = moving[i] || moving[j];
  }
  // A body held at a turned pose translates along its own oblique axes.
  const bool oblique = rotations == 3 || (rotations == 0 && !body.initial.rotation.isZero(0.0));
  if (translates && oblique)
    moving[0] = moving[1] = moving[2] = true;
  return moving;
}

bool moves(const Body& body) {
  const Six free = free_coordinates(body);
  return std::find(free.begin(), free.end(), true) != free.end();
}

std::string coordinate_of(const Scene& scene, const std::string& joint,
                          const std::optional<std::string>& coordinate) {
  const auto found = std::find_if(scene.joints.begin(), scene.joints.end(),
                                  [&](const Joint& j) { return j.name == joint; });
  return coordinate ? *coordinate
                    : joint::motion_names(*joint::find_joint_type(found->type)).front();
}

std::vector<std::string> moving_coordinates(const Scene& scene) {
  std::vector<std::string> labels;
  for (const Body& body : scene.bodies) {
    if (!body.hydro)
      continue;
    const Six moving = moving_axes(body);
    for (std::size_t i = 0; i < 6; ++i)
      if (moving[i])
        labels.push_back(hydro_label(scene, body, i));
  }
  return labels;
}

const hydro::MemoryFit* memory_fit(const Scene& scene) {
  if (!scene.hydro || !scene.database || !scene.hydro->reads().fit)
    return nullptr;
  const std::vector<std::string> moving =
      moving_coordinates(scene.pose_tables.empty() ? scene : scene_without_tables(scene));
  if (moving.empty())
    return nullptr;
  const std::vector<hydro::MemoryFit>& fits = scene.database->fits;
  const std::string remedy =
      "; make one with: hydrodae hdb fit " + scene.database->path + " all=" + joined(moving, ",");
  if (scene.hydro->fit) {
    const std::string& name = *scene.hydro->fit;
    const hydro::MemoryFit* fit = hydro::find_fit(*scene.database, name);
    if (!fit) {
      std::vector<std::string> names;
      for (const hydro::MemoryFit& f : fits)
        names.push_back(f.name);
      throw ModelError("hydro.fit", "no exponential fit " + in_quotes(name) + " in " +
                                        scene.database->path + suggestion(name, names));
    }
    const std::vector<std::string> missing = hydro::missing_inputs(*fit, moving);
    if (!missing.empty())
      throw ModelError("hydro.fit",
                       "the exponential fit " + in_quotes(name) +
                           " does not cover coordinates that move: " + joined(missing) + remedy);
    return fit;
  }
  if (const hydro::MemoryFit* fit = hydro::smallest_covering_fit(*scene.database, moving))
    return fit;
  if (fits.empty())
    throw ModelError("hydro.database", scene.database->path + " holds no exponential fit" + remedy +
                                           ", or set radiation = \"none\"");
  std::string per_fit;
  for (const hydro::MemoryFit& f : fits)
    per_fit += "; " + in_quotes(f.name) + " lacks " + joined(hydro::missing_inputs(f, moving));
  throw ModelError("hydro.database", "no exponential fit in " + scene.database->path +
                                         " covers all coordinates that move" + per_fit + remedy);
}

} // namespace hydrodae::model
