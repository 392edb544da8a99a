#pragma once
/// Ropes and quasi-static lines that know what they bear: laws of another list, whose loads end
/// where they part. The elastic energy that they hold then is lost with their ends.

#include <functional>
#include <memory>
#include <vector>

#include "hydrodae/element/elements.h"
#include "hydrodae/element/parting.h"
#include "hydrodae/element/rubbing.h"

namespace hydrodae::line {

class Breaking final : public element::Elements, public element::Parting, public element::Rubbing {
public:
  /// What a whole law bears, by what it sees and the values of its own channels.
  using Bears = std::function<element::Overload(const double* in, const double* values)>;

  /// @param whole   lists of one law each, of one shape
  /// @param bears   of each
  /// @param breaks  else what is exceeded is only reported
  Breaking(std::vector<std::shared_ptr<const element::Elements>> whole, std::vector<Bears> bears,
           bool breaks);

  void evaluate(double t, const double* in, const double* held, double* out) const override;
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override;
  void jacobian(double t, const double* in, const double* held, double* jacobian) const override;
  void energy(const double* in, const double* held, double* joules) const override;
  void observe(double t, const double* in, const double* held, const double* out,
               double* values) const override;
  void kinks(double t, const double* in, const double* held, double* out) const override;
  bool lost_at_rest(std::size_t law) const override { return whole_[law]->lost_at_rest(0); }
  std::shared_ptr<const element::Elements> started(const double* in) const override;
  std::shared_ptr<const element::Elements> statics() const override;

  bool may_part() const override { return breaks_; }
  element::Overload overload(std::size_t law, double t, const double* in,
                             const double* held) const override;

  bool may_rub() const override;
  int n_rubs() const override;
  void rubs(std::size_t law, double t, const double* in, const double* held,
            double* out) const override;
  bool settle(std::size_t law, double t, const double* in, double* held) const override;

private:
  bool has_parted(const double* held) const {
    return breaks_ && held[shape.n_signals - element::Parting::n_signals] > 0.0;
  }
  template <class S> void each(double t, const S* in, const double* held, S* out) const;

  std::vector<std::shared_ptr<const element::Elements>> whole_;
  std::vector<Bears> bears_;
  bool breaks_;
  std::size_t n_values_ = 0; ///< of the channels of a whole law
};

} // namespace hydrodae::line
