#pragma once
/// Ropes and quasi-static lines with breaking loads: they wrap the laws of another list, whose
/// loads end when they part. Their elastic energy is then lost.

#include <functional>
#include <memory>
#include <vector>

#include "hydrodae/element/elements.h"
#include "hydrodae/element/parting.h"
#include "hydrodae/element/rubbing.h"

namespace hydrodae::line {

class Breaking final : public element::Elements, public element::Parting, public element::Rubbing {
public:
  /// Overload of a whole law, from its inputs and the values of its channels.
  using Bears = std::function<element::Overload(const double* in, const double* values)>;

  /// @param whole   lists of one law each, with equal shape
  /// @param bears   overload function of each law
  /// @param breaks  true: laws part; false: an overload is only reported
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
  std::size_t n_values_ = 0; ///< number of channel values of a whole law
};

} // namespace hydrodae::line
