#include "hydrodae/line/line_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hydrodae/line/line_statics.h"

namespace hydrodae::line {

namespace {

/// Scratch of a thread.
template <class S> LineArrays<S>& line_arrays() {
  thread_local LineArrays<S> arrays;
  return arrays;
}

/// Dissipated powers of a line, and its stored energy.
struct LinePowers {
  double water = 0.0, damping = 0.0, seabed = 0.0;
};

LinePowers line_powers(const LineView<double>& at, const sea::WaveField& sea, double t,
                       const double* rates) {
  const LineModel& m = at.m;
  LinePowers out;
  for (int k = 0; k < m.n(); ++k) {
    const LineSegment& seg = m.segments[static_cast<std::size_t>(k)];
    if (seg.damping == 0.0)
      continue;
    const SegmentPull<double> p = segment_pull<double>(at, k);
    out.damping +=
        seg.damping / seg.length * p.rate * p.rate * at.damped(k, at.stretch(k, p.length)).slope;
  }
  for (int i = 0; i <= m.n(); ++i) {
    const LineNode& node = m.nodes[static_cast<std::size_t>(i)];
    const Vector3 v = at.velocity(i), x = at.place(i);
    if (m.wet) {
      const Vector3 a = m.is_end(i) ? Vector3(Vector3::Zero())
                                    : Vector3(Eigen::Map<const Vector3>(rates + 6 * i - 3));
      Vector3 f = water_force<double>(node, node_water<double>(at, sea, t, i), v, a);
      f[2] -= node.lift + node.body_lift;
      out.water -= f.dot(v);
    }
    const BedContact<double> bed = bed_contact<double>(m, node, x);
    const Vector3 elastic = node.bed_stiffness * bed.s.value * bed.up;
    out.seabed -= (bed_force<double>(m, node, bed, v) - elastic).dot(v);
  }
  return out;
}

/// Integral of tension over EA by the strain [-]; with a curve by Gauss's rule over pieces of the
/// bend of s, in which the curve may have points, and by the area of the curve beyond.
double strain_energy(const LineSegment& seg, double strain) {
  if (!seg.curve)
    return plus_integral(strain, seg.slack);
  constexpr std::array<double, 3> places = {0.238619186083197, 0.661209386466265,
                                            0.932469514203152},
                                  weights = {0.467913934572691, 0.360761573048139,
                                             0.171324492379170};
  constexpr int pieces = 8;
  const double half = 0.5 * (std::min(strain, seg.slack) + seg.slack) / pieces;
  double out = 0.0;
  for (int piece = 0; half > 0.0 && piece < pieces; ++piece)
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        const double there = half * (2.0 * piece + 1.0 + side * places[i]) - seg.slack;
        out += half * weights[i] * (*seg.curve)(plus<double>(there, seg.slack).value);
      }
  return strain > seg.slack ? out + seg.curve->area(strain) - seg.curve->area(seg.slack) : out;
}

double line_energy(const LineView<double>& at) {
  const LineModel& m = at.m;
  double out = 0.0;
  Vector3 before = Vector3::Zero();
  for (int k = 0; k < m.n(); ++k) {
    const LineSegment& seg = m.segments[static_cast<std::size_t>(k)];
    const Vector3 d = at.place(k + 1) - at.place(k), e = d.normalized();
    if (k != at.parted)
      out += seg.stiffness * seg.length * strain_energy(seg, (d.norm() - seg.length) / seg.length);
    if (k > 0)
      out += at.bending(k) * (1.0 - before.dot(e));
    before = e;
  }
  for (int i = 0; i <= m.n(); ++i) {
    const LineNode& node = m.nodes[static_cast<std::size_t>(i)];
    const Vector3 x = at.place(i);
    const double z = x[2];
    out += (node.mass * m.gravity - node.lift - node.body_lift) * z;
    if (node.bed_stiffness > 0.0)
      out += node.bed_stiffness *
             plus_integral(m.bed_at<double>(x).value + node.axis_height - z, node.bed_width);
    if (!m.is_end(i))
      out += 0.5 * node.mass * at.velocity(i).squaredNorm();
  }
  return out;
}

/// Largest overload among the whole segments.
element::Overload heaviest(const LineView<double>& at) {
  element::Overload out;
  for (int k = 0; k < at.m.n(); ++k) {
    const double ratio =
        segment_pull<double>(at, k).tension / at.m.segments[static_cast<std::size_t>(k)].strength;
    if (ratio > out.ratio)
      out = {ratio, k + 1};
  }
  return out;
}

/// Lines at rest at each instant. Each stores its last shape, so that the next search is short; not
/// thread-safe.
class LineStatics final : public element::Elements {
public:
  LineStatics(const LineList& of, std::vector<LineModel> models, sea::WaveField still,
              std::vector<Vector3> free_ends)
      : models_(std::move(models)), still_(std::move(still)), free_ends_(std::move(free_ends)),
        last_(models_.size()) {
    type = of.type;
    names = of.names;
    shape = {element::Port::points, of.shape.width, 0, 0};
  }
  void evaluate(double, const double* in, const double*, double* out) const override {
    for (std::size_t k = 0; k < size(); ++k) {
      Eigen::Map<VectorX>(out, shape.width) = rest(k, in, false).load;
      in += shape.n_in();
      out += shape.width;
    }
  }
  void evaluate(double, const Dual* in, const double*, Dual* out) const override {
    const Index w = shape.width;
    for (std::size_t k = 0; k < size(); ++k) {
      VectorX x(w), change(w);
      for (Index i = 0; i < w; ++i) {
        x[i] = in[i].a;
        change[i] = in[i].b;
      }
      const LineAtRest& at = rest(k, x.data(), true);
      change = (at.slope * change).eval();
      for (Index i = 0; i < w; ++i)
        out[i] = Dual(at.load[i], change[i]);
      in += shape.n_in();
      out += w;
    }
  }
  void jacobian(double, const double* in, const double*, double* jacobian) const override {
    const Index w = shape.width;
    for (std::size_t k = 0; k < size(); ++k) {
      Eigen::Map<MatrixX> J(jacobian, w, 2 * w);
      J.leftCols(w) = rest(k, in, true).slope;
      J.rightCols(w).setZero();
      in += 2 * w;
      jacobian += J.size();
    }
  }
  void energy(const double*, const double*, double* joules) const override {
    std::fill_n(joules, size(), 0.0);
  }
  void observe(double, const double*, const double*, const double*, double*) const override {}
  bool lost_at_rest(std::size_t) const override { return false; }

private:
  const LineAtRest& rest(std::size_t k, const double* x, bool slope) const {
    last_[k] = line_at_rest(models_[k], still_, x, free_ends_[k], names[k], slope, &last_[k]);
    return last_[k];
  }
  std::vector<LineModel> models_;
  sea::WaveField still_;
  std::vector<Vector3> free_ends_;
  mutable std::vector<LineAtRest> last_;
};

} // namespace

template <class S> void LineList::loads(double t, const S* in, const double* held, S* out) const {
  for (std::size_t k = 0; k < size(); ++k) {
    evaluate_line(tables_[k], view(k, in, held), sea_of(k), t, line_arrays<S>(), out,
                  out + shape.width);
    in += shape.n_in();
    out += shape.n_out();
  }
}

void LineList::evaluate(double t, const double* in, const double* held, double* out) const {
  loads(t, in, held, out);
}

void LineList::evaluate(double t, const Dual* in, const double* held, Dual* out) const {
  loads(t, in, held, out);
}

void LineList::jacobian(double t, const double* in, const double* held, double* jacobian) const {
  thread_local LineBlocks blocks;
  thread_local std::vector<double> out;
  out.resize(static_cast<std::size_t>(shape.n_out()));
  for (std::size_t k = 0; k < size(); ++k) {
    const LineView<double> at = view(k, in, held);
    double* const rates = out.data() + shape.width;
    evaluate_line(tables_[k], at, sea_of(k), t, line_arrays<double>(), out.data(), rates);
    jacobian = line_jacobian(at, sea_of(k), t, rates, blocks, jacobian);
    in += shape.n_in();
  }
}

void LineList::energy(const double* in, const double* held, double* joules) const {
  for (std::size_t k = 0; k < size(); ++k, in += shape.n_in())
    joules[k] = line_energy(view(k, in, held));
}

void LineList::observe(double t, const double* in, const double* held, const double* out,
                       double* values) const {
  for (std::size_t k = 0; k < size(); ++k) {
    const LineModel& m = models_[k];
    const LineView<double> at = view(k, in, held);
    const LinePowers power = line_powers(at, sea_of(k), t, out + shape.width);
    double *position = values + 8, *along = position + 3 * (m.n() + 1);
    double most = 0.0;
    for (int i = 0; i <= m.n(); ++i) {
      const Vector3 x = at.place(i);
      position = std::copy(x.data(), x.data() + 3, position);
    }
    for (int i = 0; i < m.n(); ++i) {
      along[i] = segment_pull<double>(at, i).tension;
      most = std::max(most, along[i]);
    }
    const double* load = out;
    values[0] = m.free_end ? 0.0 : Eigen::Map<const Vector3>(load + 3).norm();
    values[1] = Eigen::Map<const Vector3>(load).norm();
    values[2] = most;
    values[3] = heaviest(at).ratio;
    values[4] = line_energy(at);
    values[5] = power.water;
    values[6] = power.damping;
    values[7] = power.seabed;
    values = along + m.n();
    if (breaks_)
      values =
          std::copy_n(held + k * element::Parting::n_signals, element::Parting::n_signals, values);
    in += shape.n_in();
    out += shape.n_out();
  }
}

element::Overload LineList::overload(std::size_t law, double, const double* in,
                                     const double* held) const {
  const LineView<double> at = seen(law, in, held[0]);
  return at.parted < 0 ? heaviest(at) : element::Overload{};
}

bool LineList::lost_at_rest(std::size_t law) const {
  return std::any_of(models_[law].nodes.begin(), models_[law].nodes.end(), [](const LineNode& n) {
    return n.line.drag > 0.0 || n.line.drag_axial > 0.0 || n.body.drag > 0.0;
  });
}

/// Tolerances from the effect of an error on the tension: EA dx / l for a place, EA v / c for a
/// velocity with c = sqrt(EA l / m), relative to the largest tension at rest.
std::shared_ptr<const element::Elements> LineList::started(const double* in) const {
  constexpr double least = 1e-7, longest = 0.1; // least strain; longest error, as part of a segment
  auto out = std::make_shared<LineList>(*this);
  element::Unknown* u = out->unknowns.data();
  for (std::size_t k = 0; k < size(); ++k, in += shape.n_in()) {
    const LineModel& m = models_[k];
    const LineView<double> at = seen(k, in, 0.0);
    const LineAtRest rest = line_at_rest(m, still_, in, free_ends_[k], names[k], false);
    for (int i = 1; i <= m.n_unknown(); ++i) {
      const LineSegment& seg = m.segments[static_cast<std::size_t>(i - 1)];
      const LineNode& node = m.nodes[static_cast<std::size_t>(i)];
      const double fast = std::sqrt(seg.stiffness / (seg.length * node.mass));
      const double strain = std::clamp(rest.tension / seg.stiffness, least, longest);
      const double s = m.free_end ? 0.0 : node.at / m.nodes.back().at;
      const Vector3 v = (1.0 - s) * at.velocity(0) + s * at.velocity(m.free_end ? 0 : m.n());
      for (int c = 0; c < 6; ++c, ++u) {
        u->start = c < 3 ? rest.z[6 * (i - 1) + c] : v[c - 3];
        u->scale = strain * seg.length * (c < 3 ? 1.0 : fast);
        u->rate = u->scale * fast;
      }
    }
  }
  return out;
}

std::shared_ptr<const element::Elements> LineList::statics() const {
  return std::make_shared<const LineStatics>(*this, models_, still_, free_ends_);
}

element::WavesFelt LineList::waves() const {
  const auto n = static_cast<Index>(
      std::find(waves_.begin(), waves_.end(), true) == waves_.end() ? 0 : water_.terms.size());
  element::WavesFelt out{VectorX(n), VectorX(n), {}};
  for (Index i = 0; i < n; ++i) {
    out.omega[i] = water_.terms[static_cast<std::size_t>(i)].omega;
    out.amplitude[i] = water_.terms[static_cast<std::size_t>(i)].amplitude;
  }
  return out;
}

double LineList::elevation(double t) const {
  sea::FluidPoint<double> water;
  const Vector3 origin = Vector3::Zero();
  sea::fluid_on_line<double>(water_, t, origin, origin, 1, &water);
  return water.elevation;
}

std::shared_ptr<const element::Elements> LineList::calm() const {
  auto out = std::make_shared<LineList>(*this);
  out->water_.terms.clear();
  return out;
}

std::shared_ptr<const element::Elements>
LineList::stirred(const std::function<double()>& draw) const {
  auto out = std::make_shared<LineList>(*this);
  out->water_.ramp = 0.0;
  for (std::size_t i = 0; i < out->water_.terms.size(); ++i)
    out->water_.terms.set_phase(i, pi * draw());
  return out;
}

} // namespace hydrodae::line
