#pragma once
/// Checks that the database covers the moving coordinates.

#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/hydro/database.h"

namespace hydrodae::hydro {

const DatabaseBody* find_body(const Database& database, std::string_view name); ///< or null
const MemoryFit* find_fit(const Database& database, std::string_view name);     ///< or null

/// Labels that are not coordinates of the database.
std::vector<std::string> missing_coordinates(const Database& database,
                                             const std::vector<std::string>& labels);

/// Labels whose motion is no input of the fit.
std::vector<std::string> missing_inputs(const MemoryFit& fit,
                                        const std::vector<std::string>& labels);

/// The fit with the fewest states whose inputs include all `labels` (the first by name among
/// equals), or null.
const MemoryFit* smallest_covering_fit(const Database& database,
                                       const std::vector<std::string>& labels);

/// Returns whether the motion of one body loads the other: by added mass, damping, a fit or a
/// kernel that has been read.
bool are_coupled(const Database& database, const std::string& body, const std::string& other);

} // namespace hydrodae::hydro
