#pragma once
/// Loads of pairs of waves on a body, from a table of second order.

#include <vector>

#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/hydro/database.h"

namespace hydrodae::build {

/// One table for the coordinates of one body. The phases of both waves at its reference point are
/// taken off, then loads are interpolated linearly in both frequencies, and over headings as those
/// of the excitation (hydro/headings.h).
class PairTable {
public:
  /// @param body of the database
  /// Throws ModelError for a table that differs between both orders of two waves, or whose diagonal
  /// is not real.
  PairTable(const hydro::Database& db, const hydro::SecondOrderTable& table,
            const hydro::DatabaseBody& body);

  /// Does the table load coordinate c (0..5)?
  bool loads(int c) const { return column_[static_cast<std::size_t>(c)] >= 0; }
  bool crossed() const { return crossed_; } ///< has it pairs of different headings?
  const hydro::Headings& headings() const { return headings_; }
  const hydro::SecondOrderTable& table() const { return table_; }
  bool covers(double omega) const;

  /// T of all pairs of waves on coordinate c of the body, phases at its reference point; (n, n).
  /// Without pairs of headings all waves must travel alike. Throws ModelError for a load that is
  /// not computed.
  Eigen::MatrixXcd pairs(int c, const VectorX& omega, const VectorX& relative_heading) const;

  /// T(w, w) of each wave by itself; (n,).
  VectorX single(int c, const VectorX& omega, const VectorX& relative_heading) const;

private:
  double largest(int c) const;
  void check_orders(int c, double largest) const;
  /// T as stored, and from the same two waves in the other order; NaN where not computed.
  std::array<std::complex<double>, 2> both_orders(Index i, Index j, Index p, Index q,
                                                  Index column) const;
  std::complex<double> value(Index i, Index j, Index p, Index q, Index column) const;
  Eigen::MatrixXcd cube(Index p, Index q, int c) const;
  [[noreturn]] void refuse_missing(int c, double first, double second) const;

  const hydro::Database& db_;
  const hydro::SecondOrderTable& table_;
  const hydro::DatabaseBody& body_;
  std::array<Index, 6> column_{};
  hydro::Headings headings_;
  Eigen::MatrixXi pair_; ///< (nh, nh) place among the pairs of headings, -1: none
  bool crossed_ = false;
};

} // namespace hydrodae::build
