#include <algorithm>
#include <cmath>

#include "hydrodae/element/rope_model.h"

namespace hydrodae::element {

RopeModel::RopeModel(const Rope& of) : rope(of), winch(of), length(of.free_length()) {
  const std::vector<std::pair<std::string, Vector3>> ends = rope.ends();
  n_points = static_cast<int>(rope.points.size());
  width = 3 * static_cast<int>(ends.size());
  for (int i = 0; i < n_points; ++i)
    n_friction += rope.has_friction(static_cast<std::size_t>(i)) ? 1 : 0;
  std::vector<double> in(static_cast<std::size_t>(2 * width + 2 * n_friction), 0.0);
  for (std::size_t i = 0; i < ends.size(); ++i)
    std::copy_n(ends[i].second.data(), 3, in.data() + 3 * i);
  RopeState<double> now;
  place(in.data(), now);
  for (int k = 0; k < now.parts.n; ++k)
    free.push_back(length * now.parts.length[k] / now.parts.whole());
}

namespace {

constexpr double tolerated_strain = 1e-4; ///< of the rope, is what counts as one
constexpr double common_slip = 1.0;       ///< [m/s]

/// Ropes of one shape.
class SheavedRopes final : public Elements {
public:
  explicit SheavedRopes(const std::vector<Rope>& ropes) {
    type = Rope::type;
    for (const Rope& rope : ropes) {
      models_.emplace_back(rope);
      names.push_back(rope.name);
      declare(models_.back());
    }
    const RopeModel& first = models_.front();
    m_ = first.n_friction;
    shape = {Port::points, first.width, 2 * m_, 1, m_};
    inputs = {{"length_change", "m"}};
    lost = "ropes with friction stick at rest in the linear model, as if they could not slip";
    schedules = winch_schedules(ropes);
    signals.assign(ropes.size(), 0.0);
    channels = {
        {"tension", "N", "Largest tension of the rope."},
        {"tension_along", "N", "Tensions, from one place with friction to the next.", m_ + 1},
        {"length", "m", "Length of the rope along its points and sheaves."},
        {"winch_power", "W", "Power that the winch gives."},
        {"power_friction", "W", "Power that friction takes on its points and sheaves."},
        {"wrap", "rad", "Angles of wrap on the points between the ends.", first.n_points - 2}};
  }

  void evaluate(double t, const double* in, const double* held, double* out) const override {
    each(t, in, held, out);
  }
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override {
    each(t, in, held, out);
  }

  void jacobian(double t, const double* in, const double* held, double* jacobian) const override {
    constexpr int most = 3 * 3 * most_rope_nodes + 2 * most_rope_nodes; // three points a node
    std::array<Dual, 2 * most> x;
    std::array<Dual, most> y;
    RopeState<Dual> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      std::copy_n(in, shape.n_in(), x.begin());
      for (int column = 0; column < shape.n_in(); ++column) {
        Dual& varied = x[static_cast<std::size_t>(column)];
        varied.b = 1.0;
        models_[k].see(t, x.data(), held[k], now);
        models_[k].load(now, x.data(), y.data());
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
      m.see(0.0, in, held[k], now);
      joules[k] = 0.0;
      for (int i = 0; i <= m_ && !m.winch.winds(); ++i) { // a winch works on it besides
        const double stretch = std::max(0.0, now.parts.length[i] - now.parts.free[i]);
        joules[k] += 0.5 * m.rope.stiffness * stretch * stretch / now.parts.free[i];
      }
    }
  }

  void observe(double t, const double* in, const double* held, const double*,
               double* values) const override {
    RopeState<double> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      const RopeModel& m = models_[k];
      m.see(t, in, held[k], now);
      const double* T = now.parts.tension.data();
      double rubbed = 0.0;
      for (int j = 0; j < m_; ++j)
        rubbed += (T[j + 1] - T[j]) * m.slip(in)[j];
      *values++ = *std::max_element(T, T + m_ + 1);
      values = std::copy_n(T, m_ + 1, values);
      *values++ = now.parts.whole();
      *values++ = -T[0] * now.parts.free_rate;
      *values++ = rubbed;
      values = std::copy_n(now.path.wrap.data() + 1, m.n_points - 2, values);
    }
  }

  bool lost_at_rest(std::size_t) const override { return m_ > 0; }

  /// With one tension all along where it is.
  std::shared_ptr<const Elements> started(const double* in) const override {
    if (m_ == 0)
      return nullptr;
    auto out = std::make_shared<SheavedRopes>(*this);
    RopeState<double> now;
    Unknown* u = out->unknowns.data();
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in(), u += 2 * m_) {
      const RopeModel& m = models_[k];
      m.place(in, now);
      double passed = m.winch.winds() ? m.winch.at(0.0).a - m.length : 0.0;
      const double whole = m.length + passed;
      for (int j = 0; j < m_; ++j) {
        passed +=
            m.free[static_cast<std::size_t>(j)] - whole * now.parts.length[j] / now.parts.whole();
        u[j].start = passed;
      }
    }
    return out;
  }

  /// The same without friction.
  std::shared_ptr<const Elements> statics() const override {
    if (m_ == 0)
      return nullptr;
    std::vector<Rope> smooth;
    for (const RopeModel& m : models_) {
      smooth.push_back(m.rope);
      smooth.back().friction.clear();
    }
    return Rope::list(smooth);
  }

private:
  void declare(const RopeModel& m) {
    for (const bool slip : {false, true})
      for (std::size_t i = 0; i < m.rope.points.size(); ++i) {
        if (!m.rope.has_friction(i))
          continue;
        Unknown u;
        u.name = (slip ? "slip_" : "passed_") + std::to_string(i + 1);
        u.unit = slip ? "m/s" : "m";
        u.scale = slip ? common_slip : tolerated_strain * m.length;
        u.rate = slip ? tolerated_strain : common_slip;
        u.algebraic = slip;
        u.absolute = true;
        unknowns.push_back(u);
      }
  }

  template <class S> void each(double t, const S* in, const double* held, S* out) const {
    RopeState<S> now;
    for (std::size_t k = 0; k < size(); ++k) {
      models_[k].see(t, in, held[k], now);
      models_[k].load(now, in, out);
      in += shape.n_in();
      out += shape.n_out();
    }
  }

  std::vector<RopeModel> models_;
  int m_ = 0; ///< places with friction
};

} // namespace

std::shared_ptr<const Elements> ropes_over_sheaves(const std::vector<Rope>& ropes) {
  return std::make_shared<const SheavedRopes>(ropes);
}

} // namespace hydrodae::element
