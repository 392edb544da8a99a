#pragma once
/// The rungs of the radiation ladder: what each is called, and what it reads of the database.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace hydrodae::model {

struct RadiationRung {
  std::string_view name;      ///< word in the case
  std::string_view doc;       ///< sentence of the documentation, after the name
  bool tables = false;        ///< A(w) and B(w) are read
  bool kernel = false;        ///< K(t) is read; loads depend on the past
  bool fit = false;           ///< an exponential fit is read
  std::string_view key = {};  ///< key of [hydro] that belongs to this rung alone; "": no key
  std::string_view unit = {}; ///< unit of the key, where the rung needs the key; else ""
};

/// Cheapest first. build/radiation.cpp has the function that fills in each of them.
inline constexpr std::array<RadiationRung, 4> radiation_rungs{{
    {.name = "none", .doc = "added mass at infinite frequency only"},
    {.name = "constant",
     .doc = "added mass and damping at one frequency",
     .tables = true,
     .key = "frequency",
     .unit = "rad/s"},
    {.name = "exponential", .doc = "the fitted memory", .fit = true, .key = "fit"},
    {.name = "convolution", .doc = "the kernel K(t)", .kernel = true, .key = "memory_length"},
}};

/// The rung that a case names; the reader has refused all other words.
inline const RadiationRung& radiation_rung(std::string_view name) {
  for (const RadiationRung& rung : radiation_rungs)
    if (rung.name == name)
      return rung;
  return radiation_rungs[0];
}

/// The words of the key `radiation`.
inline std::vector<std::string_view> radiation_words() {
  std::vector<std::string_view> words;
  for (const RadiationRung& rung : radiation_rungs)
    words.push_back(rung.name);
  return words;
}

/// What the documentation says of the key `radiation`.
inline std::string_view radiation_doc() {
  static const std::string text = [] {
    std::string out = "Radiation.";
    for (const RadiationRung& rung : radiation_rungs)
      out += " " + std::string(rung.name) + ": " + std::string(rung.doc) + ".";
    return out;
  }();
  return text;
}

} // namespace hydrodae::model
