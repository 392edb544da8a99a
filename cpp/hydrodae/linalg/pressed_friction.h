#pragma once
/// Friction with a bearing in the saddle-point equations. Their solution is affine in the friction
/// loads phi: x = x_0 + X (phi - phi_0), with one column for each law. The remaining system is as
/// small as the number of such laws:
///
///   phi = f(r),   r = r_0 + D (phi - phi_0)           r: reactions on the joints, six a law
///
/// A unit load along its joint loads the bearing by N(D_kk). With f = -c N(r) the solution is
/// unique for all loads if |c| N(D_kk) < 1: N is convex, and its slopes along D_kk are at most
/// N(D_kk). Otherwise it does not exist for some loads and is not unique for others (Painleve's
/// paradox; Brogliato, Nonsmooth Mechanics, 2016, ch. 5).
///
/// In an impact phi and r are impulses; with the coefficient mu of slip, friction satisfies
///
///   |phi| <= mu N(r),   phi v <= 0,   v = 0 where |phi| < mu N(r)
///
/// where v is the rate along the joint after the impact.

#include <optional>

#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::linalg {

struct SaddlePoint::Pressed {
  struct Law {
    std::size_t list, law; ///< list in System::elements, and law in the list
  };
  std::vector<Law> laws;
  system::JacobianWorkspace ws;
  MatrixX columns;           ///< X (n_u + n_lambda, n)
  MatrixX sensitivity;       ///< D (6 n, n)
  VectorX start;             ///< r_0 (6 n,)
  VectorX load;              ///< phi (n,)
  VectorX at_rest;           ///< phi_0 (n,): friction at zero reactions
  MatrixX slope;             ///< df/dr (n, 6) of each law
  MatrixX newton;            ///< (n, n)
  VectorX reaction;          ///< r (6 n,)
  VectorX answer, gap, step; ///< (n,) scratch of `balance`
  VectorX rhs, x;            ///< (n_u + n_lambda,) right side and solution without these loads

  explicit Pressed(const system::Regime& s) : ws(s) {}

  /// Finds all laws that depend on the reaction of their joint; null: no such law.
  static std::unique_ptr<Pressed> find(const system::Regime& s);

  const system::ElementList& list(const system::Regime& s, std::size_t k) const {
    return s.elements[laws[k].list];
  }
  const system::PortData& port(const system::Regime& s, std::size_t k) const {
    return list(s, k).ports[laws[k].law];
  }

  /// Adds a load along the joint of law k to the rows of the bodies.
  void add_along(const system::Regime& s, std::size_t k, double size, VectorX& rows) const;

  /// Writes the reaction (6,) on the joint of law k in a solution.
  void see(const system::Regime& s, std::size_t k, const double* solution, double* out) const;

  /// Newton's method for phi; false without convergence.
  bool balance(const system::Regime& s, double t);

  /// Computes the loads f(r) of all laws, and their slopes.
  void evaluate(const system::Regime& s, double t, VectorX& f);

  /// Rate along the joint of law k: sum of `u` (n_u,).
  double rate_along(const system::Regime& s, std::size_t k, const double* u) const;

  /// Impulses of friction in an impact. `solution` is that without friction, from rates `u` (n_u,);
  /// on return it includes it.
  /// @returns their work [J]; nothing if no impulses fit
  std::optional<double> rub(const system::Regime& s, const VectorX& u, VectorX& solution);

  /// Message on the law with the largest excess over its limit of jamming; empty: none.
  std::string jam(const system::Regime& s) const;
};

} // namespace hydrodae::linalg
