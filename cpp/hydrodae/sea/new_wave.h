#pragma once
#include "hydrodae/sea/crest.h"
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// NewWave, the most probable shape of a large crest (Tromans, Anaturk and Hagemeijer, ISOPE 1991):
///
///   eta = A sum S_n cos(w_n (t - t0) - k_n (x - x0)) / sum S_n
///
/// on bins of equal width: S_n is the energy of the bin, w_n its middle.
struct NewWave : WaveSystem {
  static constexpr std::string_view type = "new_wave";
  static constexpr std::string_view doc =
      "NewWave: the most probable shape of a large crest (Tromans, Anaturk and Hagemeijer 1991).";
  static constexpr double usual_loss = 0.1;
  std::string spectrum = "jonswap";
  std::optional<double> period, gamma, shape;
  std::vector<double> frequency, density;
  int count = 200;
  std::vector<double> frequency_range;
  Crest crest;

  Sum components(const Site& site) const;
  std::optional<Fault> fault() const;

  template <class W = NewWave> static Fields<W> fields() {
    return system_fields<W>() +
           Fields<W>{
               {"spectrum",
                &W::spectrum,
                "-",
                "Spectrum of the sea, whose height does not matter; that of Pierson and Moskowitz "
                "has the shape of bretschneider.",
                false,
                any_value,
                {"jonswap", "bretschneider", "ochi_hubble", "table"}},
               {"peak_period", &W::period, "s",
                "Period at which the spectrum is highest; of all but a table.", false,
                more_than(0, 1e6)},
               {"gamma", &W::gamma, "-", "Peak enhancement of JONSWAP; 3.3 by default.", false,
                between(1, 20)},
               {"shape", &W::shape, "-", "Shape l of Ochi-Hubble; 1 by default.", false,
                between(0.5, 20)},
               {"frequency", &W::frequency, "rad/s", "Frequencies of a table, ascending.", false,
                more_than(0)},
               {"density", &W::density, "m2 s/rad", "Spectral density S at these frequencies.",
                false, at_least(0)},
               {"components", &W::count, "-",
                "Number of components, at equal steps of frequency: the wave repeats after 2 pi "
                "over the step.",
                false, between(2, 100000)},
           } +
           range_fields<W>();
  }
};

} // namespace hydrodae::sea
