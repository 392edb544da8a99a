#pragma once
/// Stops, one-sided distances and dry friction: constraint rows that hold at times only.
///
///   stop      open: s within its bounds;  closed: s at a bound, its load pushing back
///   friction  stick: s' = 0, |load| <= static;  slip: load = -kinetic sign(s')
///
/// Between events the equations are smooth, and any integrator solves them; the times at which a
/// row has to come or go are located on its interpolant, and it starts again there. At an impact
/// the velocities jump by impulses of the joints and stops (Newton's law of restitution; Brogliato,
/// Nonsmooth Mechanics, 2016, ch. 4). Friction that its joint presses has impulses too; other
/// friction, whose load is bounded, has no impulse. Where friction and restitution together would
/// give energy (Kane and Levinson, J. Applied Mechanics 52 (1985) 976), all rebounds are lowered
/// alike.

#include <memory>
#include <optional>

#include "hydrodae/core/error.h"
#include "hydrodae/events/source.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::events {

class Switching : public events::Source {
public:
  /// Opens all switches. Throws ModelError if the start is beyond a stop.
  Switching(system::Regime& system, double rtol);

  /// Two margins for each switch: of an open stop its gaps, of what holds its load, of what slips
  /// its rate.
  std::size_t count() const override { return 2 * size_.size(); }
  void margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) override;

  /// A step that ends at t [s] is accepted without an event of its own.
  void accept(double t, const VectorX& y, const VectorX& yp);

  /// At the start and at events: impacts, then the rows that hold from now on, by the sign of their
  /// loads. Changes the layout of the regime; y, y' come out in the new one, consistent. Throws
  /// SolverError when no consistent set of rows is found, or when events accumulate.
  /// @returns the work of all rows through their impulses [J] where something struck (that of
  /// driven rows among it); nothing: the velocities have not jumped
  std::optional<double> settle(double t, VectorX& y, VectorX& yp);

  /// Impact on a stop or one-sided joint: size of its impulse [N s or N m s], and energy lost [J].
  struct Impact {
    double time = 0.0, impulse = 0.0, energy_lost = 0.0;
  };

  /// Sums over the impacts of a stop or one-sided joint so far.
  struct Struck {
    double impulse = 0.0;     ///< sum of the impulses [N s or N m s]
    double energy_lost = 0.0; ///< [J]
    std::vector<Impact> impacts;
  };
  const std::vector<Struck>& struck() const { return state_.struck; } ///< one for each switch

  /// Angles go on from these values of all motions (of an accepted step).
  void follow(const system::Turns& turns);

  long events() const { return state_.events; }

  struct Motion { ///< s, s', s'' of the coordinate
    double value = 0.0, rate = 0.0, acceleration = 0.0;
  };

  /// Motion of switch k, at any state in the present layout.
  Motion motion_of(std::size_t k, double t, const VectorX& y, const VectorX& yp) {
    unpack(t, y, yp);
    return motion(s_.switches[k]);
  }

  /// The stop that the last `settle` found struck first, if any.
  std::optional<std::size_t> hit() const { return hit_; }

  /// State without the modes of the switches, which the regime holds.
  struct State {
    /// Depth beyond its bound at which the last event left an open stop
    std::vector<double> depth;
    std::vector<Struck> struck; ///< one for each switch
    bool holding = false;       ///< true: a switch holds
    long events = 0, recent = 0;
    double checked = 0.0; ///< [s]
    system::Turns turns;
  };
  State state() const;

  /// Goes on from an accepted instant, whose rows the regime has laid out.
  void set(State state, double t, const VectorX& y, const VectorX& yp);

private:
  using Data = system::SwitchData;
  using Mode = system::Regime::Mode;
  using Kind = Data::Kind;

  static constexpr double touching = 1e-9; ///< gap that counts as contact, in units of its length
  /// Rate or load that counts as zero, in units of its scale
  static constexpr double resting = 1e-9;

  /// Switches to the stabilised equations during its lifetime, whatever the integrator solves.
  class Stabilised {
  public:
    explicit Stabilised(system::Regime& s) : s_(s), formulation_(s.formulation) {
      s.formulation = system::Formulation::stabilised;
    }
    ~Stabilised() { s_.formulation = formulation_; }
    Stabilised(const Stabilised&) = delete;
    Stabilised& operator=(const Stabilised&) = delete;

  private:
    system::Regime& s_;
    system::Formulation formulation_;
  };

  /// The equations with the rows that hold now, ready for accelerations and impulses.
  struct Present {
    system::Pattern pattern;
    linalg::Equations equations;
    linalg::SaddlePoint saddle;
    explicit Present(const system::Regime& s)
        : pattern(system::find_pattern(s)), equations(s, pattern, 1.0), saddle(equations) {}
  };
  struct Size { ///< units of a switch
    double length = 1.0, rate = 1.0, load = 1.0;
  };

  void look(double t, const VectorX& y, const VectorX& yp);
  void unpack(double t, const VectorX& y, const VectorX& yp);
  Motion motion(const Data& element) const;
  double motion_scale(const Data& element) const;
  double load(const Data& element, const VectorX& y) const;
  double gap(std::size_t k) const;
  void margins_of(std::size_t k, double* out) const;
  double approach(std::size_t k) const;
  bool touches(std::size_t k) const;
  std::optional<double> impacts(double t, VectorX& y, VectorX& yp);
  linalg::SaddlePoint::Strike strike(double t, linalg::SaddlePoint& saddle, const VectorX& u,
                                     VectorX& y, VectorX& rates);
  double take_impact(double t, const VectorX& impulses, const VectorX& before,
                     const VectorX& after);
  bool correct(const VectorX& y, std::vector<int>& changes);
  void put(std::size_t k, Mode mode) { system::set_mode(s_, s_.switches[k], mode); }
  [[noreturn]] void fail(double t, Reason reason, const std::string& what) const;
  void count(double t);

  system::Regime& s_;
  const double rtol_;
  system::Workspace<double> ws_;
  std::vector<Size> size_;
  State state_;             ///< state without the turns, which `ws_` has
  double time_scale_ = 0.0; ///< shortest time scale of the bodies [s]
  VectorX y_, yp_;
  std::unique_ptr<Present> present_; ///< the rows that hold now
  std::optional<std::size_t> hit_;
};

} // namespace hydrodae::events
