#include "hydrodae/line/rope_capstan.h"

#include <cmath>
#include <string>

#include "hydrodae/element/rubbing.h"

namespace hydrodae::line {

namespace {

constexpr int most_points_seen = 3 * most_rope_nodes; ///< three points for each node

} // namespace

CapstanModel::CapstanModel(const Rope& of) : base(of) {
  axis_at_.fill(0);
  spin_at_.fill(-1);
  int next = base.n_points;
  for (int i = 0; i < base.n_points; ++i) {
    const auto node = static_cast<std::size_t>(i);
    rubs_[node] = of.friction_at(node) > 0.0;
    if (rubs_[node])
      nodes.push_back(i);
    if (of.has_sheave(node))
      axis_at_[node] = next++;
  }
  for (const int i : nodes)
    if (of.has_sheave(static_cast<std::size_t>(i)))
      spin_at_[static_cast<std::size_t>(i)] = next++;
}

/// Slip speeds of the places; c' is the derivative of c along the motion.
void CapstanModel::slips(double t, const double* in, const double* z, const double* held,
                         const CapstanState<double>& now, double* v) const {
  std::array<Dual, 6 * most_points_seen> moving;
  std::array<Dual, most_rope_nodes> carried;
  for (int i = 0; i < base.width; ++i) {
    moving[static_cast<std::size_t>(i)] = {in[i], in[base.width + i]};
    moving[static_cast<std::size_t>(base.width + i)] = in[base.width + i];
  }
  for (int p = 0; p < n_places(); ++p)
    carried[static_cast<std::size_t>(p)] = {z[p], now.places[p].before_rate};
  const Dual wound = winds() ? base.winch.at(t) : Dual(base.length);
  CapstanState<Dual> along;
  see<Dual>(moving.data(), carried.data(), held, wound, Dual(wound.b), along);
  for (int p = 0; p < n_places(); ++p) {
    const RopePlace<double>& place = now.places[p];
    const bool taut = now.parts[p].strain > 0.0 || now.parts[p + 1].strain > 0.0;
    v[p] = place.holds || !place.touched || !taut
               ? 0.0
               : place.flow - along.places[p].before.b * place.stretch;
  }
}

namespace {

/// Ropes with equal numbers of points, sheaves, and places with friction.
class CapstanRopes final : public element::Elements, public element::Rubbing {
public:
  /// @param rough  false: no friction, one tension and no states
  explicit CapstanRopes(const std::vector<Rope>& ropes, bool rough = true)
      : ropes_(ropes), rough_(rough) {
    type = Rope::type;
    at_rest_only = "as if nothing rubbed";
    for (const Rope& rope : ropes) {
      models_.emplace_back(rope);
      names.push_back(rope.name);
    }
    const CapstanModel& first = models_.front();
    const int n = first.n_places();
    shape = {element::Port::points, first.base.width, rough ? n : 0, 1 + 2 * n};
    inputs = {{"length_change", "m"}};
    inputs.resize(static_cast<std::size_t>(shape.n_signals));
    schedules = winch_schedules(ropes);
    tells_unknowns = false;
    channels = {
        {"tension", "N", "Largest tension of the rope."},
        {"length", "m", "Length of the rope along its points and sheaves."},
        {"winch_power", "W", "Power that the winch gives."},
        {"wrap", "rad", "Angles of wrap on the points between the ends.", first.base.n_points - 2},
        {"tensions", "N", "Tensions of the parts between places with friction.", n + 1},
        {"slip", "m/s", "Speed of the rope over the places with friction, to its last point.", n},
        {"friction_power", "W", "Power of friction along the rope, never above 0."},
        {"grip", "-",
         "Ratio of the tensions at both ends up to which friction alone can hold them apart: the "
         "product of exp(mu phi) of the places."}};
    std::vector<double> in;
    for (const Rope& rope : ropes) {
      for (const auto& end : rope.ends())
        in.insert(in.end(), end.second.begin(), end.second.end());
      in.resize(in.size() + static_cast<std::size_t>(shape.width + shape.n_states), 0.0);
    }
    start_at(in.data());
  }

  void evaluate(double t, const double* in, const double* held, double* out) const override {
    each(t, in, held, out);
  }
  void evaluate(double t, const Dual* in, const double* held, Dual* out) const override {
    each(t, in, held, out);
  }

  void jacobian(double t, const double* in, const double* held, double* jacobian) const override {
    std::array<Dual, 6 * most_points_seen + most_rope_nodes> x;
    std::array<Dual, 3 * most_points_seen + most_rope_nodes> y;
    CapstanState<Dual> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in(), held += shape.n_signals) {
      std::copy_n(in, shape.n_in(), x.begin());
      for (int column = 0; column < shape.n_in(); ++column) {
        Dual& varied = x[static_cast<std::size_t>(column)];
        varied.b = 1.0;
        answer(k, t, x.data(), held, now, y.data());
        varied.b = 0.0;
        for (int row = 0; row < shape.n_out(); ++row)
          *jacobian++ = y[static_cast<std::size_t>(row)].b;
      }
    }
  }

  void energy(const double* in, const double* held, double* joules) const override {
    CapstanState<double> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in(), held += shape.n_signals) {
      joules[k] = 0.0;
      if (models_[k].winds()) // a winch also works on the rope
        continue;
      see(k, 0.0, in, held, now);
      for (int j = 0; j <= models_[k].n_places(); ++j) {
        const RopePart<double>& part = now.parts[static_cast<std::size_t>(j)];
        joules[k] += 0.5 * models_[k].base.rope.stiffness * part.strain * part.strain *
                     part.length / (1.0 + part.strain);
      }
    }
  }

  void observe(double t, const double* in, const double* held, const double*,
               double* values) const override {
    CapstanState<double> now;
    std::array<double, most_rope_nodes> v;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in(), held += shape.n_signals) {
      const CapstanModel& m = models_[k];
      const int n = m.n_places();
      see(k, t, in, held, now);
      v.fill(0.0);
      if (rough_)
        m.slips(t, in, states_of(in), held, now, v.data());
      double power = 0.0, largest = 0.0, grip = 1.0;
      for (int j = 0; j <= n; ++j)
        largest = std::max(largest, now.parts[j].tension);
      *values++ = largest;
      *values++ = now.rope.length;
      *values++ = -now.parts[n].tension * now.free_rate;
      values = std::copy_n(now.rope.path.wrap.data() + 1, m.base.n_points - 2, values);
      for (int j = 0; j <= n; ++j)
        *values++ = now.parts[j].tension;
      for (int p = 0; p < n; ++p) {
        const double way = held[CapstanModel::way_at(p)];
        // zero slip within the step that ends it
        const double slip = way * std::max(0.0, way * v[p]);
        power += (now.parts[p].tension - now.parts[p + 1].tension) * slip;
        *values++ = slip;
        if (now.places[p].touched)
          grip *= now.places[p].grip;
      }
      *values++ = std::min(0.0, power);
      *values++ = grip;
    }
  }

  bool lost_at_rest(std::size_t) const override { return false; }

  /// Ropes that stick, with one tension, as if without friction so far.
  std::shared_ptr<const element::Elements> started(const double* in) const override {
    auto out = std::make_shared<CapstanRopes>(*this);
    out->start_at(in);
    return out;
  }
  std::shared_ptr<const element::Elements> statics() const override {
    return rough_ ? std::make_shared<CapstanRopes>(ropes_, false) : nullptr;
  }

  bool may_rub() const override { return rough_; }
  int n_rubs() const override { return 2 * models_.front().n_places(); }
  void rubs(std::size_t law, double t, const double* in, const double* held,
            double* out) const override {
    CapstanState<double> now;
    std::array<double, most_rope_nodes> v;
    see(law, t, in, held, now);
    models_[law].slips(t, in, states_of(in), held, now, v.data());
    for (int p = 0; p < models_[law].n_places(); ++p) {
      const Room room = room_at(now, p, held[CapstanModel::way_at(p)], v[p]);
      *out++ = room.forward;
      *out++ = room.backward;
    }
  }
  /// Changes one place at a time: the first that contradicts its signal.
  bool settle(std::size_t law, double t, const double* in, double* held) const override {
    const int most = 20 * (models_[law].n_places() + 1);
    for (int i = 0; i < most; ++i) {
      const Change found = change(law, t, in, held);
      if (found.place < 0)
        return i > 0;
      held[CapstanModel::way_at(found.place)] = static_cast<double>(found.to);
      held[CapstanModel::offset_at(found.place)] = found.offset;
    }
    return true;
  }

private:
  struct Change {
    int place = -1;
    Rub to = Rub::stick;
    double offset = 0.0;
  };

  const double* states_of(const double* in) const { return in + 2 * shape.width; }

  struct Room { ///< margin to slip forward or backward; for a place that slips, to sticking
    double forward = 1.0, backward = 1.0;
  };
  static Room room_at(const CapstanState<double>& now, int p, double way, double v) {
    constexpr double little = 1e-9, least = 1e-13; // strain beyond that of slip; least strain
    const RopePlace<double>& place = now.places[p];
    if (way != 0.0)
      return {v == 0.0 ? 1.0 : way * v, 1.0};
    if (!place.touched)
      return {-1.0, 1.0};
    const double E = (1.0 + little) * place.grip, before = now.parts[p].strain,
                 after = now.parts[p + 1].strain;
    return {E * before + least - after, E * after + least - before};
  }

  /// First place that contradicts the signals.
  Change change(std::size_t k, double t, const double* in, const double* held) const {
    const CapstanModel& m = models_[k];
    CapstanState<double> now;
    std::array<double, most_rope_nodes> v;
    see(k, t, in, held, now);
    m.slips(t, in, states_of(in), held, now, v.data());
    for (int p = 0; p < m.n_places(); ++p) {
      const double way = held[CapstanModel::way_at(p)];
      const Room room = room_at(now, p, way, v[p]);
      if (way == 0.0 && room.forward < 0.0)
        return {p, Rub::forward};
      if (way == 0.0 && room.backward < 0.0)
        return {p, Rub::backward};
      if (room.forward < 0.0)
        return {p, Rub::stick, now.places[p].before - states_of(in)[p]};
    }
    return {};
  }

  /// Tolerances from the effect of an error on the tension: EA dc / L, relative to the tension at
  /// the start.
  void start_at(const double* in) {
    constexpr double least = 1e-6, longest = 0.1; // strain
    const auto stride = static_cast<std::size_t>(shape.n_signals);
    signals.assign(size() * stride, 0.0);
    unknowns.clear();
    CapstanState<double> now;
    for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
      double* held = signals.data() + k * stride;
      models_[k].see<double>(0.0, in, nullptr, held, now);
      const double strain = std::clamp(now.parts[0].strain, least, longest);
      double laid = 0.0;
      for (int p = 0; p < models_[k].n_places(); ++p) {
        laid += now.parts[p].length;
        held[CapstanModel::offset_at(p)] = now.free * laid / now.rope.length;
        if (!rough_)
          continue;
        element::Unknown u;
        u.name = "over_point_" + std::to_string(models_[k].nodes[static_cast<std::size_t>(p)] + 1);
        u.unit = "m";
        u.scale = strain * now.free / (models_[k].n_places() + 1);
        unknowns.push_back(u);
      }
    }
  }

  template <class S>
  void see(std::size_t k, double t, const S* in, const double* held, CapstanState<S>& now) const {
    models_[k].see(t, in, rough_ ? in + 2 * shape.width : nullptr, held, now);
  }
  template <class S>
  void answer(std::size_t k, double t, const S* in, const double* held, CapstanState<S>& now,
              S* out) const {
    see(k, t, in, held, now);
    models_[k].load(now, out);
    for (int p = 0; p < shape.n_states; ++p)
      out[shape.width + p] = now.places[static_cast<std::size_t>(p)].before_rate;
  }
  template <class S> void each(double t, const S* in, const double* held, S* out) const {
    CapstanState<S> now;
    for (std::size_t k = 0; k < size(); ++k) {
      answer(k, t, in, held, now, out);
      in += shape.n_in();
      out += shape.n_out();
      held += shape.n_signals;
    }
  }

  std::vector<Rope> ropes_;
  bool rough_;
  std::vector<CapstanModel> models_;
};

} // namespace

std::shared_ptr<const element::Elements> ropes_with_friction(const std::vector<Rope>& ropes) {
  return std::make_shared<const CapstanRopes>(ropes);
}

} // namespace hydrodae::line
