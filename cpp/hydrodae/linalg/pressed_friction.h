#pragma once
/// Friction that the reaction of its joint presses, in the saddle-point equations. Their solution
/// is affine in the loads of friction phi: x = x_0 + X (phi - phi_0), one column for each law, so
/// that what remains is as small as there are such laws:
///
///   phi = f(r),   r = r_0 + D (phi - phi_0)           r: reactions on the joints, six a law
///
/// A load of one along its joint presses the joint by N(D_kk). With f = -c N(r) the solution is
/// unique for all loads where |c| N(D_kk) < 1: N is convex, so that its slopes along D_kk are at
/// most N(D_kk). Above, it is missing for some loads, and not unique for others (Painleve's
/// paradox; Brogliato, Nonsmooth Mechanics, 2016, ch. 5).
///
/// In an impact phi and r are impulses, whose friction, with the coefficient mu of slip, is
///
///   |phi| <= mu N(r),   phi v <= 0,   v = 0 where |phi| < mu N(r)
///
/// v: the rate along the joint afterwards.

#include <optional>

#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::linalg {

struct SaddlePoint::Pressed {
  struct Law {
    std::size_t list, law; ///< in System::elements, and in there
  };
  std::vector<Law> laws;
  system::JacobianWorkspace ws;
  MatrixX columns;           ///< X (n_u + n_lambda, n)
  MatrixX sensitivity;       ///< D (6 n, n)
  VectorX start;             ///< r_0 (6 n,)
  VectorX load;              ///< phi (n,)
  VectorX at_rest;           ///< phi_0: of reactions that are zero (n,)
  MatrixX slope;             ///< df/dr (n, 6) of each law
  MatrixX newton;            ///< (n, n)
  VectorX reaction;          ///< r (6 n,)
  VectorX answer, gap, step; ///< (n,) scratch of `balance`
  VectorX rhs, x;            ///< (n_u + n_lambda,) without these loads

  explicit Pressed(const system::Regime& s) : ws(s) {}

  /// Of all laws that feel the reaction of their joint; null if absent.
  static std::unique_ptr<Pressed> find(const system::Regime& s);

  const system::ElementList& list(const system::Regime& s, std::size_t k) const {
    return s.elements[laws[k].list];
  }
  const system::PortData& port(const system::Regime& s, std::size_t k) const {
    return list(s, k).ports[laws[k].law];
  }

  /// Adds a load along the joint of law k to the rows of the bodies.
  void add_along(const system::Regime& s, std::size_t k, double size, VectorX& rows) const;

  /// Reaction (6,) on the joint of law k in a solution.
  void see(const system::Regime& s, std::size_t k, const double* solution, double* out) const;

  /// Newton's method for phi; false where it finds none.
  bool balance(const system::Regime& s, double t);

  /// Loads f(r) of all laws, and their slopes.
  void evaluate(const system::Regime& s, double t, VectorX& f);

  /// Sum of `u` (n_u,) along the joint of law k: its rate.
  double rate_along(const system::Regime& s, std::size_t k, const double* u) const;

  /// Impulses of friction in an impact whose solution without them is `solution`, from rates `u`
  /// (n_u,), which takes their part.
  /// @returns their work [J]; nothing: none fit
  std::optional<double> rub(const system::Regime& s, const VectorX& u, VectorX& solution);

  /// The law that is nearest to jamming beyond its limit, in words; empty: none.
  std::string jam(const system::Regime& s) const;
};

} // namespace hydrodae::linalg
