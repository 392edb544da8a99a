#pragma once
/// Equations of line_model.h for all nodes of a line at once: loops over arrays, which the compiler
/// vectorises.

#include <vector>

#include "hydrodae/line/line_model.h"
#include "hydrodae/math/dual.h"

namespace hydrodae::line {

/// Parameters of a line, array by array.
struct LineTable {
  explicit LineTable(const LineModel& m);

  Eigen::ArrayXXd segments;  ///< (N, .) columns in line_table.cpp
  Eigen::ArrayXXd nodes;     ///< (N + 1, .)
  std::vector<int> attached; ///< nodes with an attachment
  /// Curve of each segment (LineSegment::curve); empty: all are linear
  std::vector<std::shared_ptr<const Curve>> curves;
  double reach = 0.0;   ///< upper bound of the height of a part above its node [m]
  double bed_top = 0.0; ///< height above which no node touches the bed [m]
};

/// Scratch of an evaluation; it keeps the forces on the nodes, without inertia.
template <class S> class LineArrays {
public:
  /// Array k of those for `nodes` nodes.
  S* column(int k) { return memory_.data() + static_cast<std::size_t>(k) * rows_; }
  void resize(int nodes, int columns) { // grows to the largest size so far
    rows_ = static_cast<std::size_t>(nodes);
    if (memory_.size() < rows_ * static_cast<std::size_t>(columns))
      memory_.resize(rows_ * static_cast<std::size_t>(columns));
  }
  Vec3<S> force(int node) { return {column(0)[node], column(1)[node], column(2)[node]}; }

private:
  std::size_t rows_ = 0;
  std::vector<S> memory_;
};

/// Loads on the ends, and rates of the states. The loops for doubles are compiled for plain
/// processors, AVX2 and AVX-512; the widest available is chosen at run time. All give the same
/// numbers.
void evaluate_line(const LineTable& table, const LineView<double>& at, const sea::WaveField& sea,
                   double t, LineArrays<double>& arrays, double* load, double* z_dot);
void evaluate_line(const LineTable& table, const LineView<Dual>& at, const sea::WaveField& sea,
                   double t, LineArrays<Dual>& arrays, Dual* load, Dual* z_dot);

} // namespace hydrodae::line
