#pragma once
/// The waves of a scene as components.

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Components of one wave system of a checked scene. A measured record is cut to its
/// `frequency_range`, or to the frequencies of the database, and so is a spectrum without a range
/// of its own. Throws ModelError when more of its variance than `lost_variance` lies outside.
std::vector<sea::Component> wave_components(const Scene& scene, const sea::Wave& wave,
                                            std::string* note = nullptr);

/// Those of all wave systems.
std::vector<sea::Component> wave_components(const Scene& scene);

/// Energy period m_{-1} / m_0 of all wave systems that are a sample of a sea: irregular or measured
/// ones [s]; 0 without any.
double irregular_period(const Scene& scene);

} // namespace hydrodae::model
