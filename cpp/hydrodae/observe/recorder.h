#pragma once
/// Columns of the results from the solution.

#include <span>

#include "hydrodae/core/channel.h"
#include "hydrodae/measure/measure.h"

namespace hydrodae::observe {

using measure::ComponentLoad, measure::Observation;
using system::BodyState, system::Regime;

/// Fills rows of the results from the sums of a Measure and its observer. It does not affect the
/// run.
class Recorder {
public:
  using Interpolant = measure::Measure::Interpolant;

  Recorder(const Regime& system, measure::Measure& measure);

  /// Channels in the order of `sample`.
  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }

  /// Fills one row at time `t` of the step (or at the start): values of all channels, of length
  /// `width()`.
  void sample(double t, const Interpolant& at, std::span<double> row);

  /// Fills the row at the end of the last closed step, from given y, y'.
  void look(const VectorX& y, const VectorX& yp, std::span<double> row);

  /// Bodies, and y, at the last sample.
  const std::vector<BodyState<double>>& bodies() const { return measure_.observer().bodies(); }
  const VectorX& state() const { return y_; }

private:
  void fill(double t, std::span<double> row);
  const Observation& seen() const { return measure_.observer().observation(); }
  void make_channels();
  void check_paths() const;
  void add_channel(std::string path, int width, std::string unit, std::string frame,
                   std::string description);
  void describe_marker(const joint::Marker& marker);
  void fill_bodies(double*& out);
  void fill_joints(double*& out);
  void fill_markers(double*& out);
  void add_gauges();
  void fill_gauges(double t, double*& out);
  void fill_energy(double t, double*& out);

  const Regime& s_;
  measure::Measure& measure_;
  std::vector<Channel> channels_;
  std::size_t width_ = 0;
  VectorX y_, yp_;
};

} // namespace hydrodae::observe
