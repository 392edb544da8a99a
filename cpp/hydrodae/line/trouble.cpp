#include "hydrodae/line/trouble.h"

#include "hydrodae/core/text.h"
#include "hydrodae/line/catenary_line.h"

namespace hydrodae::line {

std::string trouble(std::string_view type, std::span<const double> in) {
  if (type != CatenaryLine::type)
    return {};
  // A line without seabed has a balance everywhere, so this one is on the seabed.
  const double rise = in[5] - in[2]; // of end B over end A
  if (rise < 0.0)
    return "end B is " + rounded_text(-rise) +
           " m below the seabed, which is at the height of end A";
  return "a buoy, a part that floats, or what is above one, is down on the seabed, which this type "
         "does not know; type 'line' does";
}

} // namespace hydrodae::line
