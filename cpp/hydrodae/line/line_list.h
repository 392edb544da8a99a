#pragma once
/// Lines of a scene with the same number of segments, and the water around them.

#include <string>
#include <vector>

#include "hydrodae/element/elements.h"
#include "hydrodae/element/parting.h"
#include "hydrodae/line/line.h"
#include "hydrodae/line/line_table.h"

namespace hydrodae::line {

/// Model of a line.
/// @param first  unstretched length of its first part [m]
LineModel line_model(const Line& line, const element::Surroundings& around, double first);

/// Allocates nothing after a first call; thread-safe.
class LineList final : public element::Elements, public element::Parting {
public:
  LineList(const std::vector<Line>& lines, const element::Surroundings& around);

  void evaluate(double t, const double* in, const double* held, double* out) const override;
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override;
  void jacobian(double t, const double* in, const double* held, double* jacobian) const override;
  void energy(const double* in, const double* held, double* joules) const override;
  void observe(double t, const double* in, const double* held, const double* out,
               double* values) const override;
  bool may_part() const override { return breaks_; }
  element::Overload overload(std::size_t law, double t, const double* in,
                             const double* held) const override;
  bool lost_at_rest(std::size_t law) const override;
  std::shared_ptr<const element::Elements> started(const double* in) const override;
  std::shared_ptr<const element::Elements> statics() const override;
  element::WavesFelt waves() const override;
  double elevation(double t) const override;
  std::shared_ptr<const element::Elements> calm() const override;
  std::shared_ptr<const element::Elements>
  stirred(const std::function<double()>& draw) const override;

private:
  template <class S> void loads(double t, const S* in, const double* held, S* out) const;
  const sea::WaveField& sea_of(std::size_t law) const { return waves_[law] ? water_ : still_; }
  /// @param parted  segment that has parted, from 1 on; 0: whole
  template <class S> LineView<S> seen(std::size_t law, const S* in, double parted) const {
    return {models_[law], in, in + shape.width, in + 2 * shape.width, static_cast<int>(parted) - 1};
  }
  /// @param held  signals of all laws
  template <class S> LineView<S> view(std::size_t law, const S* in, const double* held) const {
    return seen(law, in, breaks_ ? held[law * element::Parting::n_signals] : 0.0);
  }

  bool breaks_ = false;
  sea::WaveField water_, still_; ///< water with the waves and without
  std::vector<LineModel> models_;
  std::vector<LineTable> tables_;  ///< tables of the models
  std::vector<bool> waves_;        ///< true if waves act on the line, for each line
  std::vector<Vector3> free_ends_; ///< points towards which free ends lie
};

} // namespace hydrodae::line
