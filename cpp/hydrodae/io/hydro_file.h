#pragma once
#include <string>

#include "hydrodae/hydro/database.h"

namespace hydrodae::io {

/// Which tables over frequency to read along.
struct HydroTables {
  bool excitation = false;
  bool radiation = false; ///< A(w) and B(w)
  bool kernel = false;    ///< K(t), if the file holds one
};

/// Reads `hydro.h5`. Throws CaseError (path, dataset, what was expected) when it is missing, not of
/// our format, or inconsistent in its shapes.
hydro::Database read_hydro_file(const std::string& path, const HydroTables& tables = {});

} // namespace hydrodae::io
