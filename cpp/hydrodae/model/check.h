#pragma once
/// Parts of `check`.

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

void check_body(const Scene& scene, const Body& body);
void check_joint(const Scene& scene, const Joint& joint);
void check_database(const Scene& scene); ///< only called when the scene has one

} // namespace hydrodae::model
