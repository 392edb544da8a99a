#pragma once
/// List of laws made of a struct that is filled from a case file. The struct, F, has
///
///   type, name, fields(), port         as every force
///   law()                              law to evaluate: F itself, or a struct of derived numbers
///
/// and its law has
///
///   operator()(In<S>, Out<S>)          load and rates of states, for S double and Dual
///   jacobian(In<double>, J)            optional, by hand; else by dual numbers, column by column
///   energy(In<double>)                 optional [J]
///   observe(In, Out, double* values)   with F::channels()
///   lost_at_rest()                     optional
///   kinks(In<double>, double* out)     with F::n_kinks
///
/// Forces on points define their number, n_points.
///
/// Optional members of F: at_rest_only, reason why a linear model says little; lost, effect that
/// the linear model lacks for laws that are lost_at_rest; work, its part in the energy balance;
/// timed, its load depends explicitly on time; buoyant and moors (see `Elements`).
///
/// A force with states defines n_states, unknowns() and n_algebraic, the number of algebraic
/// unknowns (the last ones); its law returns their residuals in place of rates. A force with inputs
/// defines n_signals, inputs() and start_signals(). A force that reads the reaction of its joint
/// defines n_reaction = 6; one that sticks at events, sticks(). A new kind of force needs one
/// header and one line in the list of forces (model/forces.h).

#include <type_traits>
#include <utility>

#include "hydrodae/element/elements.h"

namespace hydrodae::element {

template <class F> constexpr int states_of() {
  if constexpr (requires { F::n_states; })
    return F::n_states;
  return 0;
}
template <class F> constexpr int algebraic_of() {
  if constexpr (requires { F::n_algebraic; })
    return F::n_algebraic;
  return 0;
}
template <class F> constexpr int signals_of() {
  if constexpr (requires { F::n_signals; })
    return F::n_signals;
  return 0;
}
template <class F> constexpr int reaction_of() {
  if constexpr (requires { F::n_reaction; })
    return F::n_reaction;
  return 0;
}

template <class F> constexpr int kinks_of() {
  if constexpr (requires { F::n_kinks; })
    return F::n_kinks;
  return 0;
}
template <class F> constexpr int points_of() {
  if constexpr (requires { F::n_points; })
    return F::n_points;
  return 0;
}

template <class F> class Laws final : public Elements {
public:
  using Law = std::remove_cvref_t<decltype(std::declval<const F&>().law())>;
  static constexpr int w = width(F::port, points_of<F>()), nz = states_of<F>(),
                       nr = reaction_of<F>(), n_in = 2 * w + nr + nz, n_out = w + nz,
                       n_kinks_of_law = kinks_of<F>(), n_named = signals_of<F>(),
                       n_signals = n_named + n_kinks_of_law;

  Laws() {
    type = F::type;
    shape = {F::port, w, nz, n_signals, algebraic_of<F>(), nr};
    if constexpr (requires { F::timed; })
      timed = F::timed;
    absorbs = type.starts_with("pto_");
    if constexpr (requires { F::buoyant; })
      buoyant = F::buoyant;
    if constexpr (requires { F::moors; })
      moors = F::moors;
    if constexpr (requires { F::at_rest_only; })
      at_rest_only = F::at_rest_only;
    if constexpr (requires { F::lost; })
      lost = F::lost;
    if constexpr (requires { F::work; })
      work = F::work;
    if constexpr (requires { F::channels(); })
      channels = F::channels();
    n_kinks = n_kinks_of_law;
    side_at = n_named;
    if constexpr (requires { F::inputs(); })
      inputs = F::inputs();
    inputs.resize(n_signals);
  }
  explicit Laws(const std::vector<F>& forces) : Laws() {
    for (const F& force : forces)
      add(force);
  }

  void add(const F& force) {
    laws_.push_back(force.law());
    names.push_back(force.name);
    if constexpr (requires { force.start_signals(); })
      for (const double value : force.start_signals())
        signals.push_back(value);
    else
      signals.resize(signals.size() + n_named, 0.0);
    signals.resize(signals.size() + n_kinks_of_law, 0.0);
    if constexpr (requires { force.sticks(); })
      sticks.push_back(force.sticks());
    if constexpr (nz > 0)
      for (int k = 0; const Unknown& u : force.unknowns()) {
        unknowns.push_back(u);
        unknowns.back().algebraic = k++ >= nz - algebraic_of<F>();
      }
  }

  void evaluate(double t, const double* in, const double* held, double* out) const override {
    each(t, in, held, out);
  }
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override {
    each(t, in, held, out);
  }

  void jacobian(double t, const double* in, const double* held, double* J) const override {
    for (const Law& law : laws_) {
      Eigen::Map<Jacobian> j(J);
      if constexpr (requires { law.jacobian(view(t, in, held), j); })
        law.jacobian(view(t, in, held), j);
      else
        by_duals(law, t, in, held, j);
      in += n_in;
      held += n_signals;
      J += n_in * n_out;
    }
  }

  void energy(const double* in, [[maybe_unused]] const double* held,
              double* joules) const override {
    for (const Law& law : laws_) {
      *joules = 0.0;
      if constexpr (requires { law.energy(view(0.0, in, held)); })
        *joules = law.energy(view(0.0, in, held));
      ++joules;
      held += n_signals;
      in += n_in;
    }
  }

  void observe([[maybe_unused]] double t, [[maybe_unused]] const double* in,
               [[maybe_unused]] const double* held, [[maybe_unused]] const double* out,
               [[maybe_unused]] double* values) const override {
    if constexpr (requires { F::channels(); })
      for (const Law& law : laws_) {
        law.observe(view(t, in, held), Out<const double>{out, out + w}, values);
        in += n_in;
        held += n_signals;
        out += n_out;
        values += channels.size();
      }
  }

  void kinks([[maybe_unused]] double t, [[maybe_unused]] const double* in,
             [[maybe_unused]] const double* held, [[maybe_unused]] double* out) const override {
    if constexpr (n_kinks_of_law > 0)
      for (const Law& law : laws_) {
        law.kinks(view(t, in, held), out);
        in += n_in;
        held += n_signals;
        out += n_kinks_of_law;
      }
  }

  bool lost_at_rest([[maybe_unused]] std::size_t law) const override {
    if constexpr (requires { laws_[law].lost_at_rest(); })
      return laws_[law].lost_at_rest();
    return false;
  }

private:
  using Jacobian = Eigen::Matrix<double, n_out, n_in, n_out == 1 ? Eigen::RowMajor : 0>;

  template <class S> static In<S> view(double t, const S* in, const double* held) {
    return {t, in, in + w, in + 2 * w + nr, held, in + 2 * w, held ? held + n_named : nullptr};
  }

  template <class S> void each(double t, const S* in, const double* held, S* out) const {
    for (const Law& law : laws_) {
      law(view(t, in, held), Out<S>{out, out + w});
      in += n_in;
      held += n_signals;
      out += n_out;
    }
  }

  static void by_duals(const Law& law, double t, const double* in, const double* held,
                       Eigen::Map<Jacobian>& j) {
    Dual x[n_in], y[n_out];
    for (int k = 0; k < n_in; ++k)
      x[k] = in[k];
    for (int column = 0; column < n_in; ++column) {
      x[column].b = 1.0;
      law(view<Dual>(t, x, held), Out<Dual>{y, y + w});
      x[column].b = 0.0;
      for (int row = 0; row < n_out; ++row)
        j(row, column) = y[row].b;
    }
  }

  std::vector<Law> laws_;
};

} // namespace hydrodae::element
