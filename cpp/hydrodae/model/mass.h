#pragma once
#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Inertia tensor about the centre of gravity [kg m2], in body axes (the world axes of the
/// reference pose): the moments and products as given, or R diag(J1, J2, J3) R^T with the principal
/// moments J and the rotation R of `principal_axes`.
Matrix3 inertia_tensor(const Body& body);

} // namespace hydrodae::model
