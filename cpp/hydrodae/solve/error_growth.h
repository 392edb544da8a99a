#pragma once
/// The error that a run has piled up: the estimated errors of its steps, carried along by the
/// equations linearised about the motion, and added. In two ways:
///
/// With their signs (Skeel, Math. Comput. 46 (1986) 577), for methods that know them and make many
/// steps in a radian: a vector e <- Phi e + d, from look to look, and by halves of that down to
/// single steps where the equations change much, as where a rope snaps. Over thousands of periods
/// it would have to keep its phase, so errors of more than two windows of some swings ago count by
/// their size, which grows and fades as their sum does.
///
/// By size, group by group of bodies and line by line: E <- g E + |d|, where g comes of the size of
/// a vector carried from look to look. Where the equations change much between looks it is carried
/// step by step, and inside of steps once growth has been seen. Growth counts as far as it exceeds
/// the doubtful (Page's cumulative sums, Biometrika 41 (1954) 100), and what was not believed of it
/// is taken off from the next fading, lest a size that goes up and down seems to fade.

#include <functional>

#include "hydrodae/solve/linear_flow.h"

namespace hydrodae::solve {

class ImpactError;

class ErrorGrowth {
public:
  enum class Way {
    with_signs, ///< third of a radian by third of a radian
    sizes,      ///< look by look
    coherently  ///< in size radian by radian of the motion: errors of one kind, as of fixed steps
  };

  /// What there is to carry on from one layout of the rows to the next.
  struct Error {
    VectorX vector;    ///< carried along, in q, u, z (lambda0,); of this window, with signs
    VectorX middle;    ///< of the window before, with signs (lambda0,)
    VectorX old;       ///< of all before (lambda0,)
    VectorX old_piled; ///< the sum of their sizes, grown and faded as theirs (n_error_groups,)
    VectorX window;    ///< length of this one, by group [rad] (n_error_groups,)
    bool with_signs = false;
    VectorX fresh;       ///< errors since the last look (lambda0,)
    VectorX gathered;    ///< those of them whose size was added (lambda0,)
    VectorX added;       ///< sizes of these (n_error_groups,)
    VectorX piled;       ///< E, by group (n_error_groups,)
    VectorX plain;       ///< the sum without growth (n_error_groups,)
    VectorX level;       ///< ln of the factor by which the oldest of E has grown (n_error_groups,)
    VectorX change;      ///< of the equations, the largest so far (n_error_groups,)
    VectorX rough_level; ///< `level` where the equations changed much last (n_error_groups,)
    VectorX since_rough; ///< looks since then (n_error_groups,)
    void remember(Archive& a) {
      a(vector, middle, old, old_piled, window, with_signs, fresh, gathered, added, piled, plain,
        level, change, rough_level, since_rough);
    }
  };

  /// @param y, yp state at t, from which on these rows hold
  /// @param error that the run has so far; empty: none
  /// @param way to add errors
  /// @param every so many steps the error is carried along at first; where the equations change
  ///   much between two such looks, down to a quarter of that, where little, up to four times as
  ///   many
  ErrorGrowth(const system::Regime& system, const system::Pattern& pattern, double t,
              const VectorX& y, const VectorX& yp, Error error, Way way, int every);

  /// y and y' at a time inside the last step.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

  /// Adds the error of an accepted step that ends at t. True when the error was carried along.
  /// @param last of these rows: carries it along in any case
  /// @param unit what counts as one of each position and velocity, those of points too (lambda0,)
  /// @param rate of the motion of each group [1/s] (n_error_groups,)
  /// @param motion its size so far [levers or rad] (n_error_groups,)
  bool add(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate,
           const VectorX& motion, bool last, const Interpolant& at);

  /// Over an impact at the time of the last look.
  void carry_over(const ImpactError& impact, const VectorX& unit);

  const Error& error() const { return error_; }

  /// By how much E has faded for good between these looks (n_error_groups,): 1 where nothing damps.
  const VectorX& fade() const { return fade_; }

  /// Did the equations of a group change so much between these looks that its vector tells neither
  /// growth nor fading?
  bool is_rough(Index group) const;

  /// Fades E where the equations changed too much between these looks to tell.
  void fade(Index group, double factor);

  /// Largest change of stiffness and gyroscopic moments against those of the start, by group,
  /// relative to their own size (n_error_groups,): 0 where frequencies do not depend on amplitudes.
  const VectorX& change() const { return error_.change; }

  /// Do the rows that hold, those of drives among them, leave a group no motion of its own? Then
  /// errors of its steps are gone once the constraints take part.
  bool is_guided(Index group) const { return guided_[static_cast<std::size_t>(group)]; }

  /// Can looks at every step follow the errors of a group? See smooth_groups.
  bool is_smooth(Index group) const { return smooth_[static_cast<std::size_t>(group)]; }

  /// Does no body of a group float?
  bool is_dry(Index group) const { return dry_[static_cast<std::size_t>(group)]; }

  void remember(Archive& a) {
    a(error_, flow_, growth_, fade_, change_, since_, window_, every_, steps_, pieces_, n_pieces_,
      substep_, suspected_, fine_);
  }

private:
  static std::vector<bool> kinks(const system::Regime& system, Way way);
  static std::vector<bool> smooth_groups(const system::Regime& system, Way way);
  void begin(Error error);
  bool add_with_signs(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate,
                      const VectorX& motion, bool last, const Interpolant& at);
  struct Piece { ///< of a step since the last look: its end, and the error of the step if it ends
    double time = 0.0;
    VectorX y, yp, error;
    void remember(Archive& a) { a(time, y, yp, error); }
  };
  void take_in(const VectorX& fresh, const VectorX& unit, VectorX& vector) const;
  struct Closely { ///< what a closer look knows
    const VectorX &unit, &rate, &motion;
    VectorX total;  ///< sizes of the errors of all steps (n_error_groups,)
    VectorX vector; ///< of the run, as far as it is carried (lambda0,)
    std::vector<bool> lost;
  };
  void follow_pieces(std::size_t first, std::size_t n, Closely& now);
  void expect_substep(const VectorX& rate);
  void take_turn(double substep, double turned);
  void keep_piece(double t, const VectorX& error, const Interpolant& at);
  void add_plain(const VectorX& unit);
  void carry_with_signs(const VectorX& unit);
  double carry_pieces(std::size_t first, std::size_t n, const VectorX& unit);
  bool carry_piece(const Piece& piece, const VectorX& unit, VectorX& vector);
  double carry_window(std::size_t first, std::size_t n, double start, double substep,
                      const VectorX& unit);
  bool carry(double t, const VectorX& rate, VectorX& fresh);
  bool is_doubtful(const VectorX& moved) const;
  void look_closely(const VectorX& unit, const VectorX& rate, const VectorX& motion,
                    VectorX vector);
  void grow(Index group, double seen, double doubt);
  double doubt_of(Index group, double phase, double altered) const;
  void suspect(Index group, double seen);
  void look_again(double change, double much, double little);
  void take_old(const VectorX& unit, const VectorX& before);
  void limit(VectorX& vector, const VectorX& unit, const VectorX& most, double part) const;
  void keep(double t, const VectorX& step_error, const VectorX& rate, const VectorX& motion,
            const Interpolant& at);
  void follow(Index group, double phase);
  double between_rough(Index group, double level);
  VectorX sizes(const VectorX& vector, const VectorX& unit) const;
  VectorX place_sizes(VectorX vector, const VectorX& unit) const;

  const system::Regime& s_;
  LinearFlow flow_;
  Error error_;
  std::vector<bool> guided_; ///< (n_error_groups,)
  std::vector<bool> smooth_; ///< likewise: see smooth_groups
  bool any_smooth_;
  std::vector<bool> kinks_; ///< likewise: smooth, and its forces may jump
  bool any_kinks_;
  std::vector<bool> dry_; ///< likewise: no body of it in the water
  VectorX y_, yp_, growth_, fade_;
  VectorX suspected_; ///< `level` with growth over pieces too long to tell (n_error_groups,)
  VectorX change_;
  double since_ = 0.0; ///< time up to which the error was carried [s]
  double window_;      ///< time up to which errors were added in size [s]
  Way way_;
  bool fine_ = false; ///< growth has been seen: looks inside of steps
  int fewest_, most_, every_, steps_ = 0;
  std::vector<Piece> pieces_; ///< the first n_pieces_ of them are in use
  std::size_t n_pieces_ = 0;
  LinearFlow::Look last_look_;
  double substep_ = 0.0; ///< in which the vector turns by half a radian at most [s]; 0: not known
  double doubt_ = 0.0;   ///< ln of the growth since the last look that may come of its distance
  double plainly_altered_ = 0.0; ///< part of the errors that the last look's change alters
};

} // namespace hydrodae::solve
