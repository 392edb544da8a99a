#include "hydrodae/ensemble/probes.h"

#include <algorithm>

#include "hydrodae/system/declare.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::ensemble {

namespace {

/// Place of a component in a channel of `width` numbers; negative: it has no such component.
int place_of(const std::string& component, int width_of_channel) {
  if (width_of_channel == 1)
    return component.empty() ? 0 : -1;
  constexpr std::string_view names = "xyz";
  const auto place = component.size() == 1 ? names.find(component) : std::string_view::npos;
  return width_of_channel == 3 && place != std::string_view::npos ? static_cast<int>(place) : -1;
}

/// The number of a body by the last word of its channel.
std::optional<Probe> of_body(const system::Regime& s, std::size_t i, const std::string& last,
                             const std::string& component) {
  using Kind = Probe::Kind;
  struct Known {
    std::string_view name;
    Kind kind;
    std::string_view unit;
    bool moves;
  };
  static constexpr Known known[] = {
      {"position", Kind::position, "m", false},
      {"rotation", Kind::rotation, "rad", false},
      {"velocity", Kind::velocity, "m/s", true},
      {"angular_velocity", Kind::angular_velocity, "rad/s", true},
      {"acceleration", Kind::acceleration, "m/s2", true},
      {"angular_acceleration", Kind::angular_acceleration, "rad/s2", true}};
  const int c = place_of(component, 3);
  for (const Known& k : known)
    if (k.name == last && c >= 0 && (!k.moves || s.bodies[i].n_active > 0))
      return Probe{k.kind, i, c, std::string(k.unit)};
  return std::nullopt;
}

/// Do the rows of a joint that follow from others load no coordinate that moves? Then the
/// multipliers of the smallest norm are those of the rows that hold.
bool is_determined(const system::Regime& s, const system::JointData& j) {
  for (const system::RowData& row : j.rows) {
    if (s.holds(row))
      continue;
    const auto place = [&](int body, Vector3& r, Matrix3& R) {
      r = Vector3::Zero();
      R = Matrix3::Identity();
      if (body < 0)
        return;
      const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
      r = b.position;
      R = rotation_matrix<double>(b.orientation);
    };
    Vector3 r_a, r_b;
    Matrix3 R_a, R_b;
    place(j.A.body, r_a, R_a);
    place(j.B.body, r_b, R_b);
    const joint::Vector12 gradient =
        joint::basic_row<double>(row.kind, j.A, j.B, j.parameters,
                                 joint::geometry<double>(j.B, r_a, R_a, r_b, R_b))
            .gradient;
    const double rounding = 1e-12 * gradient.cwiseAbs().maxCoeff();
    for (int side = 0; side < 2; ++side) {
      const int body = side == 0 ? j.A.body : j.B.body;
      if (body < 0)
        continue;
      const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
      for (int k = 0; k < b.n_active; ++k)
        if (std::abs(gradient[6 * side + b.active[static_cast<std::size_t>(k)]]) > rounding)
          return false;
    }
  }
  return true;
}

std::optional<Probe> of_joint(const system::Regime& s, std::size_t i, const std::string& last,
                              const std::string& component) {
  const system::JointData& j = s.joints[i];
  const bool force = last == "reaction_force";
  if (force || last == "reaction_moment") {
    const int c = place_of(component, 3);
    if (c < 0 || !std::all_of(
                     s.joints.begin(), s.joints.end(),
                     [&](const auto& each) { return is_determined(s, each); }))
      return std::nullopt;
    return Probe{force ? Probe::Kind::reaction_force : Probe::Kind::reaction_moment, i, c,
                 force ? "N" : "N m"};
  }
  for (std::size_t m = 0; m < j.type->motions.size(); ++m) {
    const std::size_t number = static_cast<std::size_t>(j.first_motion) + m;
    const system::MotionData& motion = s.motions[number];
    const bool rate = last == motion.name + "_rate";
    if ((rate || last == motion.name) && component.empty())
      return Probe{rate ? Probe::Kind::motion_rate : Probe::Kind::motion, number, 0,
                   std::string(motion.motion.is_angle() ? "rad" : "m") + (rate ? "/s" : "")};
  }
  return std::nullopt;
}

/// A number that a law reports of itself (system/declare.h).
std::optional<Probe> of_law(const system::Regime& s, const Term& term) {
  for (const system::ElementList& list : s.elements) {
    system::Declaration declared;
    system::declare(s, list, declared);
    int place = 0;
    for (const Channel& channel : declared.channels) {
      if (channel.path == term.channel)
        if (const int c = place_of(term.component, channel.width); c >= 0)
          return Probe{Probe::Kind::own, system::index_of(s, list), place + c, channel.unit};
      place += channel.width;
    }
  }
  return std::nullopt;
}

/// The first list of laws that feels waves.
const system::ElementList* in_waves(const system::Regime& s) {
  for (const system::ElementList& list : s.elements)
    if (list.laws->waves().omega.size() > 0)
      return &list;
  return nullptr;
}

} // namespace

std::optional<Probe> find_probe(const system::Regime& s, const Term& term) {
  const std::size_t slash = term.channel.rfind('/');
  if (slash == std::string::npos)
    return std::nullopt;
  const std::string head = term.channel.substr(0, slash), last = term.channel.substr(slash + 1);
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (!s.bodies[i].is_mode() && head == "bodies/" + s.bodies[i].name)
      return of_body(s, i, last, term.component);
  for (std::size_t i = 0; i < s.joints.size(); ++i)
    if (!s.joints[i].hidden && head == "joints/" + s.joints[i].name)
      return of_joint(s, i, last, term.component);
  if (const system::ElementList* list = in_waves(s);
      list && term.channel == "sea/elevation" && term.component.empty())
    return Probe{Probe::Kind::elevation, system::index_of(s, *list), 0, "m"};
  return of_law(s, term);
}

std::string unknown_because(const system::Regime& regime, const std::vector<Wanted>& wanted) {
  for (const Wanted& signal : wanted)
    for (const Term& term : signal.terms)
      if (!term.channel.empty() && !find_probe(regime, term))
        return "a march does not know the channel " + term.channel +
               (term.component.empty() ? "" : "." + term.component);
  return "";
}

Probes::Probes(const LaneModel& model, const std::vector<Wanted>& wanted)
    : model_(model), own_(model.regime(0).elements.size()) {
  for (const Wanted& each : wanted) {
    Signal signal;
    for (const Term& term : each.terms) {
      Part part{std::nullopt, term.factor, term.power};
      if (!term.channel.empty()) {
        part.probe = find_probe(model.regime(0), term);
        if (signal.unit.empty())
          signal.unit = part.probe->unit;
        if (part.probe->kind == Probe::Kind::own &&
            std::find(lists_.begin(), lists_.end(), part.probe->index) == lists_.end())
          lists_.push_back(part.probe->index);
      }
      signal.parts.push_back(part);
    }
    signals_.push_back(std::move(signal));
  }
}

void Probes::read(double t, const Lanes* yp, Lanes* out) {
  read_lists(t);
  for (const Signal& signal : signals_) {
    Lanes sum(0.0);
    for (const Part& part : signal.parts) {
      Lanes value(part.factor);
      if (part.probe) {
        const Lanes x = read(*part.probe, t, yp);
        for (int k = 0; k < part.power; ++k)
          value *= x;
      }
      sum += value;
    }
    *out++ = sum;
  }
}

/// The numbers of the laws, in the order in which they are declared.
void Probes::read_lists(double t) {
  for (const std::size_t number : lists_)
    for (std::size_t k = 0; k < width; ++k) {
      const system::Regime& s = model_.regime(k);
      const system::ElementList& list = s.elements[number];
      const element::Elements& laws = *list.laws;
      const system::ElementScratch<double>& seen = model_.state(k).elements[number];
      const double *in = seen.in.data(), *load = seen.out.data();
      std::vector<double> room;
      declared_.resize(laws.size() * laws.channel_size());
      if (!declared_.empty())
        laws.observe(t, in, s.held(list, t, room), load, declared_.data());
      std::vector<double>& own = own_[number][k];
      own.clear();
      const double* declared = declared_.data();
      for (std::size_t law = 0; law < list.ports.size(); ++law) {
        const element::Shape& shape = laws.shape;
        if (element::is_along(shape.port)) {
          own.push_back(*load);
        } else if (shape.port == element::Port::between) {
          own.insert(own.end(), load, load + 6);
          own.insert(own.end(), in, in + 6);
        }
        if (laws.absorbs) {
          double power = 0.0;
          for (int c = 0; c < shape.width; ++c)
            power -= load[c] * in[shape.width + c];
          own.push_back(power);
        }
        if (laws.tells_unknowns)
          own.insert(own.end(), in + shape.n_in() - shape.n_states, in + shape.n_in());
        own.insert(own.end(), declared, declared + laws.channel_size());
        declared += laws.channel_size();
        in += shape.n_in();
        load += shape.n_out();
      }
    }
}

/// Accelerations of the coordinates of a body, or of its turning, in tangent axes.
Vec3<Lanes> Probes::rates(const Probe& probe, const Lanes* yp) const {
  const system::BodyData& data = model_.regime(0).bodies[probe.index];
  const int first = probe.kind == Probe::Kind::acceleration ? 0 : 3;
  Vec3<Lanes> out(Lanes(0.0), Lanes(0.0), Lanes(0.0));
  for (int k = 0; k < data.n_active; ++k)
    if (const int c = data.active[static_cast<std::size_t>(k)] - first; c >= 0 && c < 3)
      out[c] = yp[data.u0 + k];
  return out;
}

Lanes Probes::read(const Probe& probe, double t, const Lanes* yp) const {
  using Kind = Probe::Kind;
  if (probe.kind == Kind::motion || probe.kind == Kind::motion_rate || probe.kind == Kind::own ||
      probe.kind == Kind::rotation || probe.kind == Kind::elevation ||
      probe.kind == Kind::reaction_force || probe.kind == Kind::reaction_moment) {
    Lanes out;
    for (std::size_t k = 0; k < width; ++k)
      out.lane[k] = read_run(probe, t, k);
    return out;
  }
  const BodyLanes& b = model_.bodies()[probe.index];
  const int c = probe.component;
  const auto turned = [&](const Vec3<Lanes>& x) {
    return b.R(c, 0) * x[0] + b.R(c, 1) * x[1] + b.R(c, 2) * x[2];
  };
  switch (probe.kind) {
  case Kind::position:
    return b.r[c];
  case Kind::velocity:
    return b.v[c];
  case Kind::angular_velocity:
    return turned(b.w);
  case Kind::acceleration:
    return rates(probe, yp)[c];
  default:
    return turned(rates(probe, yp)); // the part w x w of the turning axes vanishes
  }
}

/// Of run k alone.
double Probes::read_run(const Probe& probe, double t, std::size_t k) const {
  const system::Regime& s = model_.regime(k);
  const system::Workspace<double>& state = model_.state(k);
  switch (probe.kind) {
  case Probe::Kind::own:
    return own_[probe.index][k][static_cast<std::size_t>(probe.component)];
  case Probe::Kind::elevation:
    return s.elements[probe.index].laws->elevation(t);
  case Probe::Kind::rotation:
    return system::displacement<double>(s, state, static_cast<int>(probe.index),
                                        model_.unknowns(k).data())[3 + probe.component];
  case Probe::Kind::motion:
    return system::motion_row<double>(s, state, static_cast<int>(probe.index)).value;
  case Probe::Kind::motion_rate: {
    const system::JointData& j = s.joints[static_cast<std::size_t>(s.motions[probe.index].joint)];
    return system::motion_row<double>(s, state, static_cast<int>(probe.index))
        .gradient.dot(system::joint_velocity<double>(j, state.bodies));
  }
  default:
    return reaction(probe, k);
  }
}

double Probes::reaction(const Probe& probe, std::size_t k) const {
  const system::Regime& s = model_.regime(k);
  std::size_t number = 0; // of the row among those that hold
  for (std::size_t i = 0; i < probe.index; ++i)
    for (const system::RowData& row : s.joints[i].rows)
      number += s.holds(row) ? 1 : 0;
  const system::JointData& j = s.joints[probe.index];
  const joint::Geometry<double> g = system::joint_geometry<double>(j, model_.state(k).bodies);
  joint::Vector12 load = joint::Vector12::Zero();
  for (const system::RowData& row : j.rows)
    if (s.holds(row))
      load += model_.multipliers()[number++].lane[k] *
              joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient;
  const Vector6 out = joint::reaction(load, j.A, j.B, g);
  return out[probe.component + (probe.kind == Probe::Kind::reaction_force ? 0 : 3)];
}

} // namespace hydrodae::ensemble
