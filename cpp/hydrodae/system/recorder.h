#pragma once
/// From the solution to the columns of the results.

#include <functional>
#include <span>

#include "hydrodae/core/channel.h"
#include "hydrodae/system/observer.h"

namespace hydrodae::system {

/// Integrates the work of every force over the accepted steps, follows angles over turns, and fills
/// rows of the results. Lives in accepted-step state: call `accept` once a step, in order.
class Recorder {
public:
  /// y and y' at a time inside the step that was accepted last.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

  Recorder(const System& system, double t0, const VectorX& y, const VectorX& yp);

  /// The columns, in the order of `sample`.
  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }

  /// Fills one row at time `t` of the current step (or the start). Values of all channels one after
  /// the other; length `width()`.
  void sample(double t, const Interpolant& at, std::span<double> row);

  /// Closes the step that ends at `t`: work and turns are carried over.
  void accept(double t, const Interpolant& at);

  /// Largest |balance error| so far over the largest energy exchanged so far [-].
  double relative_balance_error() const;

private:
  void make_channels();
  void add_channel(std::string path, int width, std::string unit, std::string frame,
                   std::string description);
  std::vector<double> work_until(double t, const Interpolant& at, std::vector<double>& power);
  void fill_bodies(double*& out);
  void fill_joints(double*& out);
  void fill_energy(double*& out, const std::vector<double>& work);

  const System& s_;
  Observer observer_;
  std::vector<Channel> channels_;
  std::size_t width_ = 0;
  double t_;                         ///< end of the last accepted step [s]
  std::vector<double> power_, work_; ///< per component, at t_
  double energy0_ = 0.0;             ///< kinetic energies at the start [J]
  double largest_energy_ = 0.0, largest_error_ = 0.0;
  VectorX y_, yp_;
};

} // namespace hydrodae::system
