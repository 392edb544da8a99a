#pragma once
/// Waves of a scene as components.

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Components of one wave system of a checked scene. A measured record, or a spectrum without its
/// own range, is cut to its `frequency_range` or to the frequencies of the database. Throws
/// ModelError if more of its variance than `lost_variance` lies outside.
std::vector<sea::Component> wave_components(const Scene& scene, const sea::Wave& wave,
                                            std::string* note = nullptr);

/// Components of all wave systems.
std::vector<sea::Component> wave_components(const Scene& scene);

/// Energy period m_{-1} / m_0 of all irregular or measured wave systems [s]; 0 without any. A sea
/// whose phases or crests are prescribed is no random sample of a sea state: 0, too.
double irregular_period(const Scene& scene);

} // namespace hydrodae::model
