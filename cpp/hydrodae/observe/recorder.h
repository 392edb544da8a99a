#pragma once
/// Columns of the results from the solution.

#include <span>

#include "hydrodae/observe/channel_table.h"

namespace hydrodae::observe {

using system::BodyState, system::Regime;

/// Fills rows of the results from the sums of a Measure and its observer. It does not affect the
/// run.
class Recorder {
public:
  using Interpolant = measure::Measure::Interpolant;

  Recorder(const Regime& system, measure::Measure& measure)
      : measure_(measure), table_(channel_table(system, measure)) {}

  /// The columns, in the order of `sample`.
  const std::vector<Channel>& channels() const { return table_.channels(); }
  std::size_t width() const { return table_.width(); }

  /// Fills one row at time `t` of the step begun (or at the start). Values of all channels one
  /// after the other; length `width()`.
  void sample(double t, const Interpolant& at, std::span<double> row) {
    at(t, y_, yp_);
    fill(t, row);
  }

  /// Fills the row of the end of the last closed step, where y, y' are given.
  void look(const VectorX& y, const VectorX& yp, std::span<double> row) {
    y_ = y;
    yp_ = yp;
    fill(measure_.start(), row);
  }

  /// Bodies, and y, at the last sample.
  const std::vector<BodyState<double>>& bodies() const { return measure_.observer().bodies(); }
  const VectorX& state() const { return y_; }

private:
  void fill(double t, std::span<double> row) {
    const measure::Observation& seen = measure_.observer().observe(t, y_, yp_);
    table_.write({t, seen, bodies(), measure_, y_, measure_.work_at(t)}, row.data());
  }

  measure::Measure& measure_;
  ChannelTable table_;
  VectorX y_, yp_;
};

} // namespace hydrodae::observe
