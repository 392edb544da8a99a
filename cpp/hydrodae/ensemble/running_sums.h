#pragma once
/// Measures of a march as running sums of its accepted steps.
///
/// Means, mean squares and Fourier integrals have the weights of the method, as one more unknown
/// would: they have its order, 8. Turning points lie on the polynomial of each step
/// (step_polynomial.h). The means of spans, whose ends lie within steps, take a cubic there: they
/// serve intervals alone.

#include "hydrodae/ensemble/probes.h"
#include "hydrodae/ensemble/step_polynomial.h"
#include "hydrodae/ensemble/turning_points.h"

namespace hydrodae::ensemble {

class RunningSums {
public:
  /// @param ramp end of the ramp [s], where signals without a start begin
  /// @param end of the runs [s]
  RunningSums(const LaneModel& model, const std::vector<Wanted>& wanted, double ramp, double end);

  bool empty() const { return records_.empty(); }
  /// Is a turning point asked for at this time, so that steps need their inner stages?
  bool looks_inside(double t) const;
  /// The first time after t that a step has to end at [s]; `end` where no step has to.
  double next_stop(double t) const;

  /// Takes the values of a stage, or of the end (12), from the last `accelerations`.
  void see(std::size_t stage, double t, const Lanes* yp);
  /// The end of the last step is the start of the next.
  void begin_step();
  /// The step is not accepted: its start is the end of the last one again.
  void reject();
  /// Adds an accepted step [t0, t0 + h], all stages of which have been seen.
  void add(double t0, double h);

  /// Measured values of run k.
  std::vector<Measured> of(std::size_t k) const;

private:
  struct Record {
    Wanted wanted;
    double start = 0.0;
    Lanes sum{0.0}, squares{0.0}, cosine{0.0}, sine{0.0}, least{HUGE_VAL}, most{-HUGE_VAL};
    std::vector<Lanes> sums_at, squares_at; ///< at the ends of the spans so far
    std::array<TurningPoints, width> turns;
  };

  void add_sums(Record& record, std::size_t signal, double t0, double h);
  void add_spans(Record& record, std::size_t signal, double t0, double h, const Lanes& sum,
                 const Lanes& squares);
  void add_turns(Record& record, std::size_t signal, double t0, double h);
  Lanes value(std::size_t stage, std::size_t signal) const {
    return values_[stage * records_.size() + signal];
  }

  Probes probes_;
  const double end_;
  std::vector<Record> records_;
  std::vector<Lanes> values_; ///< by stage and signal
};

} // namespace hydrodae::ensemble
