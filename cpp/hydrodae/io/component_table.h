#pragma once
#include <string>

#include "hydrodae/sea/component_file.h"

namespace hydrodae::io {

/// Reads the components of a wave from a text file with commas: columns omega [rad/s], amplitude
/// [m], phase [rad] and, where there is one, heading [deg], in any order; a unit in brackets must
/// be this one. Other columns are passed over. Throws CaseError "<file>:<line>:<column>: ...".
void read_component_table(const std::string& path, sea::ComponentFile& wave);

} // namespace hydrodae::io
