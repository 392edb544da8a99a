#include "hydrodae/line/trouble.h"

#include "hydrodae/core/text.h"
#include "hydrodae/line/catenary_line.h"

namespace hydrodae::line {

std::string trouble(std::string_view type, std::span<const double> in) {
  if (type != CatenaryLine::type)
    return {};
  const double rise = in[5] - in[2]; // height of end B above end A
  if (rise < 0.0)
    return "end B is " + rounded_text(-rise) +
           " m below the seabed, which is at the height of end A";
  return "a buoy or a part that floats is down on the seabed, or a part that floats lies on the "
         "surface; this type cannot compute that; use type 'line'";
}

} // namespace hydrodae::line
