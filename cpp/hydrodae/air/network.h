#pragma once
/// Chambers connected by outlets, as one law: one state for each chamber, and ports along the
/// coordinates of all their pistons.

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "hydrodae/air/parts.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::air {

/// Network of chambers. Its coordinates are the pistons, its states the masses of the chambers.
class Network final : public element::Elements {
public:
  explicit Network(Parts of);

  void evaluate(double t, const double* in, const double* held, double* out) const override;
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override;
  void jacobian(double t, const double* in, const double* held, double* J) const override;
  void energy(const double* in, const double* held, double* joules) const override;
  void observe(double t, const double* in, const double* held, const double* out,
               double* values) const override;
  void kinks(double t, const double* in, const double* held, double* out) const override;
  std::string trouble(std::size_t law, const double* in) const override;
  bool lost_at_rest(std::size_t) const override { return false; }
  std::shared_ptr<const Elements> started(const double* in) const override;
  std::shared_ptr<const Elements> statics() const override;

private:
  /// Air of one chamber.
  template <class S> struct Air {
    S volume, mass;   ///< [m3], [kg]
    S gauge, density; ///< [Pa], [kg/m3]
  };
  struct Way {
    int from = 0, to = -1; ///< chambers; to = -1: the atmosphere
    int kink = -1;         ///< index of its side after `side_at`; -1: no kink
    int signal = -1;       ///< index among the signals; -1: no signal
    int rotor = -1;        ///< index of its speed among the states; -1: no rotor
  };

  Network(Parts of, std::vector<double> masses, bool still);
  void add_way(AnyOutlet& outlet);
  void name_states();
  void find_rest();
  void name_channels();
  template <class S> S room_left(std::size_t chamber, const S* x) const;
  template <class S> S volume(std::size_t chamber, const S* x) const;
  template <class S> void set_pressure(std::size_t chamber, Air<S>& air) const;
  template <class S> void find_air(const S* in, std::vector<Air<S>>& air) const;
  template <class S> void share(const S* x, std::vector<Air<S>>& air) const;
  template <class S> S speed(std::size_t outlet, const S* in, const double* held) const;
  template <class S> S drop(const Way& way, const std::vector<Air<S>>& air) const;
  Held held_of(const Way& way, const double* held) const;
  template <class S> struct Stream;
  template <class S>
  Stream<S> stream(std::size_t outlet, const S* in, const double* held,
                   const std::vector<Air<S>>& air) const;
  void observe_turbine(std::size_t outlet, const Stream<double>& s, double* values) const;
  template <class S> void answer(const S* in, const double* held, S* out) const;
  double heat(int chamber, const std::vector<Air<double>>& air) const;

  Parts parts_;
  std::vector<int> chamber_of_; ///< chamber of each piston
  std::vector<Way> ways_;       ///< connection of each outlet
  int n_states_ = 0;            ///< number of chambers and rotors
  std::vector<double> masses_;  ///< masses at the start [kg]
  /// Group of chambers that share air at rest; -1: with the atmosphere
  std::vector<int> rest_;
  bool begun_ = false; ///< true: masses of a start; false: of the reference pose
  bool still_ = false; ///< true: at rest, without states
  std::deque<std::string> texts_;
};

} // namespace hydrodae::air
