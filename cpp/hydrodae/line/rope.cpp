#include "hydrodae/line/rope.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/line/breaking.h"
#include "hydrodae/line/rope_model.h"

namespace hydrodae::line {

std::vector<element::Schedule> winch_schedules(const std::vector<Rope>& ropes) {
  std::vector<element::Schedule> out;
  for (const Rope& rope : ropes) {
    const std::vector<double>& times = rope.winch_time;
    double finest = INFINITY;
    for (std::size_t i = 1; i < times.size(); ++i)
      finest = std::min(finest, 0.5 * (times[i] - times[i - 1]));
    if (!times.empty())
      out.push_back({"the winch of rope '" + rope.name + "'", finest,
                     [winch = Winch(rope)](double t) { return winch.at(t).a; }});
  }
  return out;
}

namespace {

/// Ropes over an equal number of points.
class RopeList final : public element::Elements {
public:
  explicit RopeList(const std::vector<Rope>& ropes)
      : n_(static_cast<int>(ropes.front().points.size())) {
    type = Rope::type;
    shape = {element::Port::points, 3 * n_, 0, 2};
    inputs = {{"length_change", "m"}, {}};
    n_kinks = side_at = 1;
    channels = {{"tension", "N", "Tension of the rope."},
                {"length", "m", "Length of the rope along its points."},
                {"winch_power", "W", "Power that the winch gives."}};
    for (const Rope& rope : ropes) {
      names.push_back(rope.name);
      laws_.push_back({rope.stiffness, rope.damping, rope.free_length(), Winch(rope)});
    }
    signals.assign(2 * ropes.size(), 0.0);
    schedules = winch_schedules(ropes);
  }

  void evaluate(double t, const double* in, const double* held, double* out) const override {
    each(t, in, held, out);
  }
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override {
    each(t, in, held, out);
  }

  /// Jacobian with g = dl/dx: load = -T g, T_x = (EA g + D dl'/dx) / L0, T_v = D g / L0.
  void jacobian(double t, const double* in, const double* held, double* jacobian) const override {
    for (std::size_t k = 0; k < laws_.size(); ++k) {
      const int w = shape.width;
      Eigen::Map<MatrixX> J(jacobian, w, 2 * w);
      J.setZero();
      const State<double> now = pull<double>(laws_[k], t, in, held + 2 * k);
      if (now.pulls) {
        const double c = laws_[k].damping / now.free;
        for (int i = 0; i < n_; ++i)
          for (int j = 0; j < n_; ++j) {
            const Vector3 gi = slope(in, i), gj = slope(in, j);
            const Vector3 by_x = laws_[k].stiffness / now.free * gj + c * rate_slope(in, j);
            J.block<3, 3>(3 * i, 3 * j) -= gi * by_x.transpose();
            J.block<3, 3>(3 * i, w + 3 * j) -= c * gi * gj.transpose();
          }
        for (int i = 0; i + 1 < n_; ++i) { // Term -T d g / dx of each span.
          const Vector3 d = span(in, i), e = d.normalized();
          const Matrix3 P = now.tension / d.norm() * (Matrix3::Identity() - e * e.transpose());
          J.block<3, 3>(3 * i, 3 * i) -= P;
          J.block<3, 3>(3 * i + 3, 3 * i + 3) -= P;
          J.block<3, 3>(3 * i, 3 * i + 3) += P;
          J.block<3, 3>(3 * i + 3, 3 * i) += P;
        }
      }
      in += 2 * w;
      jacobian += 2 * w * w;
    }
  }

  void energy(const double* in, const double* held, double* joules) const override {
    for (std::size_t k = 0; k < laws_.size(); ++k, in += 2 * shape.width) {
      const double free = laws_[k].length + held[2 * k]; // a winch also works on the rope
      const double stretch = std::max(0.0, total<double>(in) - free);
      joules[k] =
          !laws_[k].winch.winds() ? 0.5 * laws_[k].stiffness * stretch * stretch / free : 0.0;
    }
  }

  void observe(double t, const double* in, const double* held, const double*,
               double* values) const override {
    for (std::size_t k = 0; k < laws_.size(); ++k, in += 2 * shape.width, values += 3) {
      const State<double> now = pull<double>(laws_[k], t, in, held + 2 * k);
      values[0] = now.tension;
      values[1] = total<double>(in);
      values[2] = -now.tension * now.free_rate;
    }
  }

  void kinks(double t, const double* in, const double* held, double* out) const override {
    for (std::size_t k = 0; k < laws_.size(); ++k, in += 2 * shape.width)
      out[k] = pull<double>(laws_[k], t, in, held + 2 * k).tautness;
  }

  bool lost_at_rest(std::size_t) const override { return false; }

private:
  struct Law {
    double stiffness, damping, length;
    Winch winch;
  };
  template <class S> struct State {
    S tension;
    double free, free_rate; ///< unstretched length L0 and its rate
    S tautness{0};          ///< see RopeState
    bool pulls = false;
  };

  template <class S> static Vec3<S> point(const S* in, int i) {
    return Eigen::Map<const Vec3<S>>(in + 3 * i);
  }
  template <class S> Vec3<S> velocity(const S* in, int i) const {
    return Eigen::Map<const Vec3<S>>(in + shape.width + 3 * i);
  }
  static Vector3 span(const double* in, int i) { return point(in, i + 1) - point(in, i); }

  template <class S> static S size(const Vec3<S>& d) {
    using std::sqrt;
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  template <class S> S total(const S* in) const {
    S sum(0);
    for (int i = 0; i + 1 < n_; ++i)
      sum += size<S>(point(in, i + 1) - point(in, i));
    return sum;
  }

  template <class S>
  State<S> pull(const Law& law, double t, const S* in, const double* held) const {
    State<S> out{S(0), law.length + held[0], 0.0, S(0), false};
    if (law.winch.winds()) {
      const Dual now = law.winch.at(t);
      out.free = now.a + held[0];
      out.free_rate = now.b;
    }
    const S strain = (total(in) - S(out.free)) / S(out.free);
    S T = S(0);
    if (strain > S(0) || held[1] > 0.0) {
      S rate(0);
      for (int i = 0; i + 1 < n_; ++i) {
        const Vec3<S> d = point(in, i + 1) - point(in, i);
        rate += d.cwiseProduct(velocity(in, i + 1) - velocity(in, i)).sum() / size<S>(d);
      }
      T = S(law.stiffness) * strain + S(law.damping) * (rate - S(out.free_rate)) / S(out.free);
    }
    out.tautness = tautness_of(strain, T / S(law.stiffness));
    out.pulls = rope_pulls(out.tautness, held[1]);
    if (out.pulls)
      out.tension = T;
    return out;
  }

  template <class S> void each(double t, const S* in, const double* held, S* out) const {
    for (std::size_t k = 0; k < laws_.size(); ++k) {
      const State<S> now = pull(laws_[k], t, in, held + 2 * k);
      std::fill_n(out, shape.width, S(0));
      for (int i = 0; i + 1 < n_ && now.pulls; ++i) {
        const Vec3<S> d = point(in, i + 1) - point(in, i);
        const S part = now.tension / size<S>(d);
        for (int c = 0; c < 3; ++c) {
          out[3 * i + c] += part * d[c];
          out[3 * i + 3 + c] -= part * d[c];
        }
      }
      in += 2 * shape.width;
      out += shape.width;
    }
  }

  /// Derivative of l by the place of point i.
  Vector3 slope(const double* in, int i) const {
    Vector3 out = Vector3::Zero();
    if (i > 0)
      out += span(in, i - 1).normalized();
    if (i + 1 < n_)
      out -= span(in, i).normalized();
    return out;
  }
  /// Derivative of l' by the place of point i.
  Vector3 rate_slope(const double* in, int i) const {
    Vector3 out = Vector3::Zero();
    const auto across = [&](int k) {
      const Vector3 d = span(in, k), e = d.normalized(), v = velocity(in, k + 1) - velocity(in, k);
      return Vector3((v - e * e.dot(v)) / d.norm());
    };
    if (i > 0)
      out += across(i - 1);
    if (i + 1 < n_)
      out -= across(i);
    return out;
  }

  int n_;
  std::vector<Law> laws_;
};

} // namespace

std::shared_ptr<const element::Elements> Rope::list(const std::vector<Rope>& ropes) {
  if (ropes.front().breaking_load) {
    std::vector<std::shared_ptr<const element::Elements>> whole;
    std::vector<Breaking::Bears> bears;
    for (Rope rope : ropes) {
      // The first channel of all ropes is the largest tension.
      bears.emplace_back([load = *rope.breaking_load](const double*, const double* values) {
        return element::Overload{values[0] / load, 1};
      });
      rope.breaking_load.reset();
      whole.push_back(list({rope}));
    }
    return std::make_shared<const Breaking>(whole, bears, ropes.front().breaks);
  }
  if (ropes.front().has_friction())
    return ropes_with_friction(ropes);
  if (!ropes.front().is_plain())
    return ropes_over_sheaves(ropes);
  return std::make_shared<const RopeList>(ropes);
}

} // namespace hydrodae::line
