#pragma once
/// Bodies that deform: 6 + n coordinates, n amplitudes of modes.
///
/// In the scene each mode and each attachment is an additional body after those of the case
/// (Body::part). A mode is a body that moves along x only: its displacement is the amplitude q, its
/// mass the modal mass, and no weight acts along x. An attachment is a body without mass that
/// conditions hold to the deformed place. Layout, methods, events, linear model and estimates thus
/// need no special case, and scenes without modes no additional work.

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Adds the bodies of modes and attachments to the scene. Throws ModelError if an entry names no
/// body, or its number of vectors differs from the number of modes of its body.
void add_parts(Scene& scene);

/// Indices in Scene::modes of the modes of a body, in the order of the case.
std::vector<std::size_t> modes_of(const Scene& scene, std::string_view body);

/// Body of a mode, in the scene with its parts; its x is the amplitude.
const Body& part_of_mode(const Scene& scene, std::size_t mode);

/// Returns whether modes of a body can take part in its motion along body axis c (0, 1, 2). Normal
/// modes of a body that moves freely there have no share of its momentum.
bool may_participate(const Scene& scene, const Body& body, std::size_t c);

/// Mass (6 + n, 6 + n) that the n modes of a body share with each other and with its rigid motions;
/// the diagonal is zero.
MatrixX shared_mass(const Scene& scene, std::string_view body);

/// Checks the requirements of the parts: masses of one distribution, participation for held bodies
/// only, hydrodynamic axes that do not turn, and a database with the modes. Throws ModelError.
void check_parts(const Scene& scene);

/// Label of coordinate c of a body in databases, "barge.heave"; for a mode "barge.bend" along x,
/// and empty along the others. The body must have `hydro`.
std::string hydro_label(const Scene& scene, const Body& body, std::size_t c);

} // namespace hydrodae::model
