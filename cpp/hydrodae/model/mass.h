#pragma once
#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Inertia tensor about the centre of gravity [kg m2], in body axes (the world axes of the
/// reference pose): the given moments and products, or R diag(J1, J2, J3) R^T with the principal
/// moments J and the rotation R of `principal_axes`.
Matrix3 inertia_tensor(const Body& body);

/// Fills in masses and moments of inertia that a case gives by a word or by radii of gyration:
/// `value` of `mass` and `inertia`, for "mesh" also `products_of_inertia`. Databases and meshes
/// must be loaded. Throws ModelError if the displaced volume, the density or the mesh is missing.
void fill_in_masses(Scene& scene);

} // namespace hydrodae::model
