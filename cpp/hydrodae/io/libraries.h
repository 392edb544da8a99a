#pragma once
/// Shared libraries with force laws (element/plugin.h).

#include <string>
#include <vector>

#include "hydrodae/model/scene.h"

namespace hydrodae::io {

/// Loads the libraries, which stay loaded as long as the program runs, and gives every force of
/// type library_load and library_wrench its law. Only load what is to be trusted: a library is a
/// program. Throws CaseError where a library cannot be used or a force finds no law in them.
void join_libraries(const std::vector<std::string>& paths, model::Scene& scene);

} // namespace hydrodae::io
