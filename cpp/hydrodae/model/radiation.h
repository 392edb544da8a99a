#pragma once
/// Words and keys of radiation and of its axes in a case, from the lists of the water
/// (water/radiation.h, water/hydro_axes.h).

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/water/radiation.h"

namespace hydrodae::model {

/// Calls `visit(std::type_identity<Rung>{})` for the rung with this word; the reader has refused
/// all other words.
template <class Visit> void visit_rung(std::string_view word, Visit&& visit) {
  water::for_each_rung([&]<class Rung>(std::type_identity<Rung> rung) {
    if (Rung::type == word)
      visit(rung);
  });
}

/// What a rung reads of the database.
struct RungReads {
  bool tables = false, kernel = false, fit = false;
};
inline RungReads reads_of(std::string_view word) {
  RungReads out;
  visit_rung(word, [&]<class Rung>(std::type_identity<Rung>) {
    out = {Rung::reads_tables, Rung::reads_kernel, Rung::reads_fit};
  });
  return out;
}

/// Words of the key `radiation`.
inline std::vector<std::string_view> radiation_words() {
  std::vector<std::string_view> words;
  water::for_each_rung([&]<class Rung>(std::type_identity<Rung>) { words.push_back(Rung::type); });
  return words;
}

/// Documentation of the key `radiation`.
inline std::string_view radiation_doc() {
  static const std::string text = [] {
    std::string out = "Radiation.";
    water::for_each_rung([&]<class Rung>(std::type_identity<Rung>) {
      out += " " + std::string(Rung::type) + ": " + std::string(Rung::doc) + ".";
    });
    return out;
  }();
  return text;
}

/// Axes of a word; the reader has refused all others.
inline water::HydroAxes axes_of(std::string_view word) {
  return std::ranges::find(water::axes_words, word, &water::AxesWord::word)->axes;
}

/// Words of the key `axes`.
inline std::vector<std::string_view> axes_choices() {
  std::vector<std::string_view> words;
  for (const water::AxesWord& row : water::axes_words)
    words.push_back(row.word);
  return words;
}

/// Documentation of the key `axes`.
inline std::string_view axes_doc() {
  static const std::string text = [] {
    std::string out = "Axes in which added mass, radiation and excitation act.";
    for (const water::AxesWord& row : water::axes_words)
      out += " " + std::string(row.word) + ": " + std::string(row.doc) + ".";
    return out;
  }();
  return text;
}

/// Keys of [hydro] that belong to single rungs; H derives from water::RadiationKeys.
template <class H> Fields<H> radiation_keys() {
  Fields<H> out;
  water::for_each_rung([&]<class Rung>(std::type_identity<Rung>) {
    const Fields<H> own = Rung::template keys<H>();
    out.insert(out.end(), own.begin(), own.end());
  });
  return out;
}

} // namespace hydrodae::model
