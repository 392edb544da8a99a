/// Tables [[chamber]], [[piston]] and [[outlet]]: what is refused, and where.

#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {

/// A column on a slide below a chamber with a plug; `more` is appended.
std::string message(const std::string& more, const std::string& air = "volume = 90.0",
                    const std::string& press = "joint = \"column\"\narea = 10.0") {
  const std::string text =
      "[[body]]\nname = \"column\"\nmotion = \"heave\"\nmass = 100.0\n"
      "center_of_gravity = [0, 0, 0]\n"
      "[[joint]]\nname = \"column\"\ntype = \"prismatic\"\n"
      "body_a = \"ground\"\nbody_b = \"column\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n"
      "[[chamber]]\nname = \"air\"\n" +
      air + "\n[[piston]]\nname = \"water\"\nchamber = \"air\"\n" + press +
      "\n[[outlet]]\ntype = \"porous_plug\"\nname = \"plug\"\n"
      "chamber = \"air\"\nconductance = 1e-4\n"
      "[solver]\nend_time = 1.0\n" +
      more;
  return message_of([&] { io::parse_case(text, ""); });
}

bool has(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a chamber with a piston and a plug is read") { CHECK(message("") == "no error"); }

TEST_CASE("air of a chamber") {
  has(message("", "volume = 0.0"), "volume");
  has(message("", "volume = 90.0\nexponent = 1.7"), "exponent");
  has(message("", "volume = 90.0\npressure = -2e5"), "is a gauge pressure");
  has(message("[environment]\nair_pressure = 0.0"), "air_pressure");
  has(message("[environment]\nair_pressure = 1.013"), "give the absolute pressure");
  has(message("[environment]\nair_pressure = 101.3"), "in Pa, such as 101325");
  has(message("[[chamber]]\nname = \"tank\"\nvolume = 3.0"), "neither pistons nor outlets");
  has(message("[[chamber]]\nname = \"air\"\nvolume = 3.0"), "two chamber entries");
}

TEST_CASE("pistons") {
  has(message("", "volume = 90.0", "joint = \"column\"\narea = 0.0"), "area");
  has(message("", "volume = 90.0", "area = 1.0"), "needs either 'joint' or 'mode'");
  has(message("", "volume = 90.0", "joint = \"colum\"\narea = 1.0"), "did you mean");
  has(message("", "volume = 90.0", "mode = \"bend\"\narea = 1.0"), "is no mode");
  has(message("", "volume = 90.0", "joint = \"column\"\nmode = \"bend\"\narea = 1.0"),
      "needs either 'joint' or 'mode'");
}

TEST_CASE("outlets") {
  const std::string wells = "[[outlet]]\ntype = \"wells\"\nname = \"turbine\"\nchamber = \"air\"\n"
                            "diameter = 0.7\nflow_slope = 0.8\n";
  has(message(wells + "speed = 0.0"), "speed");
  has(message(wells + "speed = 90.0\nstall = 0.1"), "stall_slope");
  const std::string hole = "[[outlet]]\ntype = \"orifice\"\nname = \"hole\"\narea = 0.1\n"
                           "coefficient = 0.6\n";
  has(message(hole + "chamber = \"aire\""), "did you mean");
  has(message(hole + "chamber = \"air\"\nto = \"air\""), "leads back");
  has(message(hole + "chamber = \"air\"\nto = \"tank\"\n[[chamber]]\nname = \"tank\"\n"
                     "volume = 3.0\nexponent = 1.0"),
      "different 'exponent'");
  has(message("[[outlet]]\ntype = \"hole\"\nname = \"b\"\nchamber = \"air\""), "orifice");
}
