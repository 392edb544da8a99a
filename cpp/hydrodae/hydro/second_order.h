#pragma once
/// Tables of the loads of pairs of waves, as `hydro.h5` holds them.
///
/// Waves i and j of complex amplitudes A_i, A_j at the origin of the world have, over all ordered
/// pairs, the loads
///
///   difference  Re(A_i conj(A_j) T_ij e^{i (w_i - w_j) t})   T_ji = conj T_ij
///   sum         Re(A_i A_j T_ij e^{i (w_i + w_j) t})         T_ji = T_ij
///
/// so that one wave of amplitude a has the mean T a^2. A table of kind `mean` has the diagonal of
/// the differences alone.

#include <array>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::hydro {

struct SecondOrderKind {
  std::string_view name;
  bool one_axis;  ///< loads of single waves; else of pairs
  bool symmetric; ///< T_ji = T_ij; else Hermitian
};
inline constexpr std::array<SecondOrderKind, 3> second_order_kinds{
    {{"mean", true, false}, {"difference", false, false}, {"sum", false, true}}};

/// Kind of a table by its name; null where there is no such kind.
inline const SecondOrderKind* second_order_kind(std::string_view name) {
  for (const SecondOrderKind& kind : second_order_kinds)
    if (kind.name == name)
      return &kind;
  return nullptr;
}

struct SecondOrderTable {
  std::string kind;                         ///< name of one of `second_order_kinds`
  std::vector<std::string> coordinates;     ///< (n,) labels "<body>.<dof>"
  std::vector<std::string> method;          ///< (n,) how each was computed
  VectorX omega;                            ///< (nw,) ascending [rad/s]
  VectorX heading1, heading2;               ///< (nh,) directions of the first and second wave [rad]
  std::vector<std::complex<double>> values; ///< (nw, nh, n) of "mean", else (nw, nw, nh, n)
  std::vector<char> computed;               ///< the same shape: does the source hold the load?
  std::string source;

  bool one_axis() const { return second_order_kind(kind)->one_axis; }
  bool symmetric() const { return second_order_kind(kind)->symmetric; }
  /// Where the load of frequencies i and j, pair of headings h and coordinate c stands.
  std::size_t at(Index i, Index j, Index h, Index c) const {
    const Index row = one_axis() ? i : i * omega.size() + j;
    return static_cast<std::size_t>(
        (row * heading1.size() + h) * static_cast<Index>(coordinates.size()) + c);
  }
};

} // namespace hydrodae::hydro
