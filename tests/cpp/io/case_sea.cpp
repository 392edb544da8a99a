/// Mistakes in [sea], [[wave]] and the radiation rungs are reported with their place.

#include "hydrodae/io/case_reader.h"
#include "support.h"

namespace {

using namespace hydrodae;

std::string message(const std::string& wave) {
  return tests::message_of([&] { io::parse_case(tests::flap_case + wave, ".", {}, "case.toml"); });
}

} // namespace

TEST_CASE("a mistake in a wave is told with its place") {
  const std::string head = "\n[[wave]]\nname = \"w\"\n"; // line 40
  const auto line = [](const std::string& text) { return text.substr(0, text.find(": ")); };
  CHECK(tests::contains(message(head + "type = \"jonswop\"\n"), "did you mean 'jonswap'?"));
  CHECK(message(head + "type = \"regular\"\nheight = 1.0\n") ==
        "case.toml:40:1: missing key 'period' in [[wave]] 'w' (Period of a regular wave [s])");
  const std::string gamma =
      message(head + "type = \"bretschneider\"\nsignificant_height = 1.0\npeak_period = 8.0\n"
                     "gamma = 2.0\n");
  CHECK(line(gamma).starts_with("case.toml:45:"));
  CHECK(tests::contains(gamma, "unknown key 'gamma' in [[wave]] 'w' of type bretschneider"));
  CHECK(tests::contains(message(head + "type = \"pierson_moskowitz\"\nsignificant_height = 1.0\n"
                                       "peak_period = 8.0\n"),
                        "unknown key 'peak_period'"));
  CHECK(tests::contains(message(head + "type = \"table\"\nfrequency = [1.0, 0.5]\n"
                                       "density = [1.0, 1.0]\n"),
                        "the frequencies must ascend"));
  CHECK(tests::contains(message(head + "type = \"regular\"\nheight = 1.0\nperiod = 5.0\n"),
                        "the table [hydro] is missing"));
  CHECK(tests::contains(message("\n[sea]\nramp = 5.0\n"), "there is no [[wave]] to ramp up"));
  CHECK(tests::contains(message("\n[sea]\ncurrent = [1.0, 0.0, 0.0]\n"),
                        "and the case has no such element"));
  CHECK(tests::contains(message("\n[sea]\nphase = \"moving\"\n"),
                        "and the case lacks waves or database"));
  CHECK(tests::contains(message(head + "type = \"measured\"\n"),
                        "a measured wave needs 'file', or 'time' and 'elevation'"));
}
