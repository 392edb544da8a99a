#pragma once
#include <memory>
#include <string>

#include "hydrodae/hydro/database.h"

namespace hydrodae::io {

/// Selection of frequency tables to read.
struct HydroTables {
  bool excitation = false;
  bool radiation = false;    ///< A(w) and B(w)
  bool kernel = false;       ///< K(t), if the file holds one
  bool second_order = false; ///< loads of pairs of waves, if the file holds them
  bool operator==(const HydroTables&) const = default;
};

/// Reads `hydro.h5`. Throws CaseError (path, dataset, expectation) if it is missing, in another
/// format, or inconsistent in its shapes.
hydro::Database read_hydro_file(const std::string& path, const HydroTables& tables = {});

/// Database of a file with the digest of its bytes.
struct SharedHydroFile {
  std::shared_ptr<const hydro::Database> database;
  std::string sha256;
};

/// Database shared by all scenes that hold it at a time, by path and digest.
SharedHydroFile shared_hydro_file(const std::string& path, const HydroTables& tables);

} // namespace hydrodae::io
