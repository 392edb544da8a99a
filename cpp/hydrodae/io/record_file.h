#pragma once
#include <string>
#include <vector>

namespace hydrodae::io {

/// Reads the columns `time` [s] and `elevation` [m] of a text file with commas; their names stand
/// in its first line (a unit in brackets may follow), other columns are passed over, and so are
/// empty lines and those that begin with #. Throws CaseError "<file>:<line>:<column>: ...".
void read_record(const std::string& path, std::vector<double>& time,
                 std::vector<double>& elevation);

} // namespace hydrodae::io
