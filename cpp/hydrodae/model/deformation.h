#pragma once
/// Bodies that deform: 6 + n coordinates, n amplitudes of modes.
///
/// In the scene each mode and each attachment is a body of its own, behind those of the case
/// (Body::part). A mode is a body that moves along x alone: its displacement is the amplitude q,
/// its mass the modal mass, and no weight acts along x. An attachment is a body without mass that
/// conditions hold to the deformed place. So layout, methods, events, linear model and estimates
/// need to know of neither, and a scene without modes has nothing of them.

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Adds the bodies of modes and attachments to the scene that was read. Throws ModelError where an
/// entry names no body, or has another number of vectors than its body has modes.
void add_parts(Scene& scene);

/// Numbers in Scene::modes of the modes of a body, in their order in the case.
std::vector<std::size_t> modes_of(const Scene& scene, std::string_view body);

/// The amplitude of a mode in the scene with its parts.
const Body& part_of_mode(const Scene& scene, std::size_t mode);

/// Can modes of a body take part in its motion along axis c of the body (0, 1, 2)? Normal modes of
/// a body that moves freely there have no share of its momentum.
bool may_participate(const Scene& scene, const Body& body, std::size_t c);

/// What the parts need: participation of held bodies alone, hydrodynamic axes that do not turn, and
/// a database that knows the modes.
/// Throws ModelError.
void check_parts(const Scene& scene);

/// "barge.heave" of coordinate c of a body, as in databases; of a mode "barge.bend" along x, and
/// nothing along the others. The body must have `hydro`.
std::string hydro_label(const Scene& scene, const Body& body, std::size_t c);

} // namespace hydrodae::model
