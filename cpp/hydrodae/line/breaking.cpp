#include "hydrodae/line/breaking.h"

#include <algorithm>
#include <utility>

namespace hydrodae::line {

namespace {

/// Rubbing interface of a law; null: the law does not rub.
const element::Rubbing* rubbing(const std::shared_ptr<const element::Elements>& whole) {
  const auto* laws = dynamic_cast<const element::Rubbing*>(whole.get());
  return laws && laws->may_rub() ? laws : nullptr;
}

} // namespace

Breaking::Breaking(std::vector<std::shared_ptr<const element::Elements>> whole,
                   std::vector<Bears> bears, bool breaks)
    : whole_(std::move(whole)), bears_(std::move(bears)), breaks_(breaks) {
  const element::Elements& first = *whole_.front();
  type = first.type;
  shape = first.shape;
  work = first.work;
  at_rest_only = first.at_rest_only;
  lost = first.lost;
  tells_unknowns = first.tells_unknowns;
  sparsity = first.sparsity;
  inputs = first.inputs;
  channels = first.channels;
  n_values_ = first.channel_size();
  n_kinks = first.n_kinks;
  side_at = first.side_at;
  channels.push_back({"tension_ratio", "-", "Largest tension over breaking load."});
  if (breaks_) {
    shape.n_signals += element::Parting::n_signals;
    inputs.resize(static_cast<std::size_t>(shape.n_signals));
    channels.push_back({"parted", "-",
                        "Part that has parted, counted from the first end on; 0 "
                        "while it is whole."});
    channels.push_back({"parted_at", "s", "When it has parted; 0 while it is whole."});
  }
  for (const std::shared_ptr<const element::Elements>& one : whole_) {
    names.push_back(one->names.front());
    unknowns.insert(unknowns.end(), one->unknowns.begin(), one->unknowns.end());
    schedules.insert(schedules.end(), one->schedules.begin(), one->schedules.end());
    signals.insert(signals.end(), one->signals.begin(), one->signals.end());
    if (breaks_)
      signals.insert(signals.end(), element::Parting::n_signals, 0.0);
  }
}

template <class S> void Breaking::each(double t, const S* in, const double* held, S* out) const {
  for (const std::shared_ptr<const element::Elements>& one : whole_) {
    if (has_parted(held))
      std::fill_n(out, shape.n_out(), S(0));
    else
      one->evaluate(t, in, held, out);
    in += shape.n_in();
    held += shape.n_signals;
    out += shape.n_out();
  }
}

void Breaking::evaluate(double t, const double* in, const double* held, double* out) const {
  each(t, in, held, out);
}

void Breaking::evaluate(double t, const Dual* in, const double* held, Dual* out) const {
  each(t, in, held, out);
}

void Breaking::jacobian(double t, const double* in, const double* held, double* jacobian) const {
  for (const std::shared_ptr<const element::Elements>& one : whole_) {
    if (has_parted(held))
      std::fill_n(jacobian, jacobian_size(), 0.0);
    else
      one->jacobian(t, in, held, jacobian);
    in += shape.n_in();
    held += shape.n_signals;
    jacobian += jacobian_size();
  }
}

void Breaking::energy(const double* in, const double* held, double* joules) const {
  for (const std::shared_ptr<const element::Elements>& one : whole_) {
    *joules = 0.0;
    if (!has_parted(held))
      one->energy(in, held, joules);
    in += shape.n_in();
    held += shape.n_signals;
    ++joules;
  }
}

void Breaking::observe(double t, const double* in, const double* held, const double* out,
                       double* values) const {
  for (std::size_t k = 0; k < size(); ++k) {
    const bool parted = has_parted(held);
    whole_[k]->observe(t, in, held, out, values);
    const double ratio = parted ? 0.0 : bears_[k](in, values).ratio;
    if (parted) // the ends of a parted law are loose
      std::fill_n(values, n_values_, 0.0);
    values += n_values_;
    *values++ = ratio;
    if (breaks_)
      values = std::copy_n(held + shape.n_signals - element::Parting::n_signals,
                           element::Parting::n_signals, values);
    in += shape.n_in();
    held += shape.n_signals;
    out += shape.n_out();
  }
}

std::shared_ptr<const element::Elements> Breaking::started(const double* in) const {
  std::vector<std::shared_ptr<const element::Elements>> out;
  bool any = false;
  for (std::size_t k = 0; k < size(); ++k) {
    std::shared_ptr<const element::Elements> one =
        whole_[k]->started(in + k * static_cast<std::size_t>(shape.n_in()));
    any = any || one;
    out.push_back(one ? one : whole_[k]);
  }
  return any ? std::make_shared<const Breaking>(out, bears_, breaks_) : nullptr;
}

/// Laws at rest, which are whole.
std::shared_ptr<const element::Elements> Breaking::statics() const {
  std::vector<std::shared_ptr<const element::Elements>> out;
  bool any = false;
  for (const std::shared_ptr<const element::Elements>& one : whole_) {
    std::shared_ptr<const element::Elements> still = one->statics();
    any = any || still;
    out.push_back(still ? still : one);
  }
  return any ? std::make_shared<const Breaking>(out, bears_, breaks_) : nullptr;
}

element::Overload Breaking::overload(std::size_t law, double t, const double* in,
                                     const double* held) const {
  if (has_parted(held))
    return {};
  thread_local std::vector<double> out, values;
  out.resize(static_cast<std::size_t>(shape.n_out()));
  values.resize(n_values_);
  whole_[law]->evaluate(t, in, held, out.data());
  whole_[law]->observe(t, in, held, out.data(), values.data());
  return bears_[law](in, values.data());
}

bool Breaking::may_rub() const { return rubbing(whole_.front()); }

int Breaking::n_rubs() const { return rubbing(whole_.front())->n_rubs(); }

void Breaking::rubs(std::size_t law, double t, const double* in, const double* held,
                    double* out) const {
  if (has_parted(held))
    std::fill_n(out, n_rubs(), 1.0);
  else
    rubbing(whole_[law])->rubs(0, t, in, held, out);
}

void Breaking::kinks(double t, const double* in, const double* held, double* out) const {
  for (const std::shared_ptr<const element::Elements>& one : whole_) {
    if (has_parted(held))
      std::fill_n(out, n_kinks, -1.0);
    else
      one->kinks(t, in, held, out);
    in += shape.n_in();
    held += shape.n_signals;
    out += n_kinks;
  }
}

bool Breaking::settle(std::size_t law, double t, const double* in, double* held) const {
  return !has_parted(held) && rubbing(whole_[law])->settle(0, t, in, held);
}

} // namespace hydrodae::line
