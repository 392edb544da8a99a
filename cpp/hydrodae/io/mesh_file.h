#pragma once
#include <string>

#include "hydrodae/hull/mesh.h"

namespace hydrodae::io {

/// Vertices and triangles of a file, not yet checked to be a closed surface.
struct Surface {
  hull::Vertices vertices;   ///< (n, 3) [m]; each place once
  hull::Triangles triangles; ///< (m, 3)
};

/// Reads an .stl file (text or binary) or an .obj file, whose polygons are cut into triangles.
/// Vertices nearer to each other than 1e-6 of the size of the surface are one. Throws CaseError
/// with file and line.
Surface read_surface(const std::string& path);

} // namespace hydrodae::io
