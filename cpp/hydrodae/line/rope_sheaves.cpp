#include <algorithm>

#include "hydrodae/line/rope_model.h"

namespace hydrodae::line {

namespace {

/// Ropes with equal numbers of points and sheaves.
class SheavedRopes final : public element::Elements {
public:
  explicit SheavedRopes(const std::vector<Rope>& ropes) {
    type = Rope::type;
    for (const Rope& rope : ropes) {
      models_.emplace_back(rope);
      names.push_back(rope.name);
    }
    const RopeModel& first = models_.front();
    shape = {element::Port::points, first.width, 0, 2};
    inputs = {{"length_change", "m"}, {}};
    schedules = winch_schedules(ropes);
    signals.assign(2 * ropes.size(), 0.0);
    n_kinks = side_at = 1;
    channels = {
        {"tension", "N", "Tension of the rope."},
        {"length", "m", "Length of the rope along its points and sheaves."},
        {"winch_power", "W", "Power that the winch gives."},
        {"wrap", "rad", "Angles of wrap on the points between the ends.", first.n_points - 2}};
  }

  void evaluate(double t, const double* in, const double* held, double* out) const override {
    each(t, in, held, out);
  }
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override {
    each(t, in, held, out);
  }

  void jacobian(double t, const double* in, const double* held, double* jacobian) const override {
    constexpr int most = 2 * 3 * most_rope_nodes; // two points for each node
    std::array<Dual, 2 * most> x;
    std::array<Dual, most> y;
    RopeState<Dual> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      std::copy_n(in, shape.n_in(), x.begin());
      for (int column = 0; column < shape.n_in(); ++column) {
        Dual& varied = x[static_cast<std::size_t>(column)];
        varied.b = 1.0;
        models_[k].see(t, x.data(), held + 2 * k, now);
        models_[k].load(now, y.data());
        varied.b = 0.0;
        for (int row = 0; row < shape.n_out(); ++row)
          *jacobian++ = y[static_cast<std::size_t>(row)].b;
      }
    }
  }

  void energy(const double* in, const double* held, double* joules) const override {
    RopeState<double> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      const RopeModel& m = models_[k];
      m.see(0.0, in, held + 2 * k, now);
      const double stretch = std::max(0.0, now.length - now.free);
      joules[k] = m.winch.winds() ? 0.0 // a winch also works on the rope
                                  : 0.5 * m.rope.stiffness * stretch * stretch / now.free;
    }
  }

  void observe(double t, const double* in, const double* held, const double*,
               double* values) const override {
    RopeState<double> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      const RopeModel& m = models_[k];
      m.see(t, in, held + 2 * k, now);
      *values++ = now.tension;
      *values++ = now.length;
      *values++ = -now.tension * now.free_rate;
      values = std::copy_n(now.path.wrap.data() + 1, m.n_points - 2, values);
    }
  }

  void kinks(double t, const double* in, const double* held, double* out) const override {
    RopeState<double> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      models_[k].see(t, in, held + 2 * k, now);
      out[k] = now.tautness;
    }
  }

  bool lost_at_rest(std::size_t) const override { return false; }

private:
  template <class S> void each(double t, const S* in, const double* held, S* out) const {
    RopeState<S> now;
    for (std::size_t k = 0; k < size(); ++k) {
      models_[k].see(t, in, held + 2 * k, now);
      models_[k].load(now, out);
      in += shape.n_in();
      out += shape.n_out();
    }
  }

  std::vector<RopeModel> models_;
};

} // namespace

std::shared_ptr<const element::Elements> ropes_over_sheaves(const std::vector<Rope>& ropes) {
  return std::make_shared<const SheavedRopes>(ropes);
}

} // namespace hydrodae::line
