#pragma once
/// Radiation of a scene: one function a rung, and what they share.

#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::build {

/// Each fills in `s.hydro` from the database of `scene`: `added_mass_all`, then damping, memory
/// (`blocks`, `inputs`, `output_all`) or `convolution`, for the bodies that are wet in `scene`.
/// Returns the labels of the loads that its source gives. Throws ModelError.
using FillRadiation = std::vector<std::string>(const model::Scene& scene, system::System& s);
FillRadiation fill_no_radiation, fill_constant; // radiation_constant.cpp
FillRadiation fill_exponential;                 // radiation_exponential.cpp
FillRadiation fill_convolution;                 // radiation_convolution.cpp

/// Place of each coordinate of the bodies (6 n_bodies,) among `labels`, -1 where it is absent.
std::vector<int> all_places(const model::Scene& scene, const system::HydroData& h,
                            const std::vector<std::string>& labels);

/// Place of each coordinate of U among `labels`, -1 where it is absent.
std::vector<int> places(const model::Scene& scene, const system::HydroData& h,
                        const std::vector<std::string>& labels);

/// Rows for all six coordinates of all bodies (zero where the source gives none) and columns for U.
MatrixX cut(const model::Scene& scene, const system::HydroData& h,
            const std::vector<std::string>& rows, const std::vector<std::string>& columns,
            const MatrixX& source);

/// The rows of `all` (6 per body) that belong to U.
MatrixX moving_rows(const system::HydroData& h, const MatrixX& all);

} // namespace hydrodae::build
