#include "hydrodae/ensemble/running_sums.h"

#include <algorithm>

#include "hydrodae/integrate/dormand_prince_8.h"

namespace hydrodae::ensemble {

namespace {

using integrate::tableaux::rk8_b;
using integrate::tableaux::rk8_c;

/// Points of a step between which a turning point is looked for: two in each half wave of the
/// derivative, a polynomial of degree 5, if its five zeros are evenly spaced.
constexpr std::size_t looks = 10;

/// Newton steps from the secant of an interval of a tenth of a step. The value there errs by the
/// square of the error of the place: two steps leave less than rounding.
constexpr int refinements = 3;

/// Coefficients of c within a step, by power of x, lane by lane.
HYDRODAE_WIDE void combine(const Lanes* values, std::size_t stride, Lanes* out) {
  const StepPolynomial& w = step_polynomial();
  for (std::size_t m = 0; m < polynomial_size; ++m) {
    out[m] = Lanes(0.0);
    for (std::size_t j = 0; j < polynomial_stages; ++j)
      if (w[m][j] != 0.0)
        out[m] += Lanes(w[m][j]) * values[j * stride];
  }
}

/// Derivatives at `looks` + 1 points of the step.
HYDRODAE_WIDE void slopes(const Lanes* c, Lanes* out) {
  for (std::size_t i = 0; i <= looks; ++i) {
    const Lanes x(static_cast<double>(i) / looks);
    Lanes sum(0.0);
    for (std::size_t m = polynomial_size - 1; m >= 1; --m)
      sum = sum * x + Lanes(static_cast<double>(m)) * c[m];
    out[i] = sum;
  }
}

/// The polynomial of one lane, or its derivative.
struct Curve {
  double c[polynomial_size];
  double value(double x) const {
    double sum = 0.0;
    for (std::size_t m = polynomial_size; m-- > 0;)
      sum = sum * x + c[m];
    return sum;
  }
  double slope(double x) const {
    double sum = 0.0;
    for (std::size_t m = polynomial_size - 1; m >= 1; --m)
      sum = sum * x + static_cast<double>(m) * c[m];
    return sum;
  }
  double curvature(double x) const {
    double sum = 0.0;
    for (std::size_t m = polynomial_size - 1; m >= 2; --m)
      sum = sum * x + static_cast<double>(m * (m - 1)) * c[m];
    return sum;
  }
};

/// Where the slope is zero between a and b, at which it has these two values.
double turning_place(const Curve& curve, double a, double b, double at_a, double at_b) {
  double x = a + (b - a) * at_a / (at_a - at_b);
  for (int k = 0; k < refinements; ++k)
    if (const double bend = curve.curvature(x); bend != 0.0)
      x = std::clamp(x - curve.slope(x) / bend, a, b);
  return x;
}

} // namespace

RunningSums::RunningSums(const LaneModel& model, const std::vector<Wanted>& wanted, double ramp,
                         double end)
    : probes_(model, wanted), end_(end) {
  for (const Wanted& each : wanted) {
    Record record;
    record.wanted = each;
    record.start = each.start < 0.0 ? ramp : each.start;
    records_.push_back(std::move(record));
  }
  values_.assign(polynomial_stages * records_.size(), Lanes(0.0));
}

bool RunningSums::looks_inside(double t) const {
  return std::any_of(records_.begin(), records_.end(),
                     [&](const Record& r) { return r.wanted.turns && t >= r.start; });
}

double RunningSums::next_stop(double t) const {
  double out = end_;
  for (const Record& record : records_)
    if (record.start > t)
      out = std::min(out, record.start);
  return out;
}

void RunningSums::see(std::size_t stage, double t, const Lanes* yp) {
  if (!empty())
    probes_.read(t, yp, values_.data() + stage * records_.size());
}

void RunningSums::begin_step() {
  std::copy_n(values_.begin() + static_cast<long>(stages * records_.size()), records_.size(),
              values_.begin());
}

void RunningSums::reject() {
  std::copy_n(values_.begin(), records_.size(),
              values_.begin() + static_cast<long>(stages * records_.size()));
}

void RunningSums::add(double t0, double h) {
  for (std::size_t i = 0; i < records_.size(); ++i)
    if (Record& record = records_[i]; t0 >= record.start) {
      add_sums(record, i, t0, h);
      if (record.wanted.turns)
        add_turns(record, i, t0, h);
    }
}

void RunningSums::add_sums(Record& record, std::size_t signal, double t0, double h) {
  const Lanes sum = record.sum, squares = record.squares;
  const double omega = 2.0 * pi * record.wanted.frequency;
  for (std::size_t j = 0; j < stages; ++j) {
    if (rk8_b[j] == 0.0)
      continue;
    const Lanes x = value(j, signal), part = Lanes(h * rk8_b[j]) * x;
    record.sum += part;
    record.squares += part * x;
    for (std::size_t k = 0; k < width; ++k) {
      record.least.lane[k] = std::min(record.least.lane[k], x.lane[k]);
      record.most.lane[k] = std::max(record.most.lane[k], x.lane[k]);
    }
    if (omega >= 0.0) {
      const double angle = omega * (t0 + rk8_c[j] * h);
      record.cosine += part * Lanes(std::cos(angle));
      record.sine += part * Lanes(std::sin(angle));
    }
  }
  add_spans(record, signal, t0, h, sum, squares);
}

/// The sums at the ends of spans in this step, by the cubic polynomial through sums and rates.
void RunningSums::add_spans(Record& record, std::size_t signal, double t0, double h,
                            const Lanes& sum, const Lanes& squares) {
  const Lanes a = value(0, signal), b = value(stages, signal);
  const auto between = [&](double x, const Lanes& from, const Lanes& to, const Lanes& rate_from,
                           const Lanes& rate_to) {
    const double z = 1.0 - x, by_end = x * x * (3.0 - 2.0 * x);
    return Lanes(1.0 - by_end) * from + Lanes(by_end) * to +
           Lanes(h * x * z) * (Lanes(z) * rate_from - Lanes(x) * rate_to);
  };
  const double length = (end_ - record.start) / sampling_spans;
  while (record.sums_at.size() + 1 < sampling_spans) {
    const double t = record.start + length * static_cast<double>(record.sums_at.size() + 1);
    if (t > t0 + h)
      return;
    const double x = (t - t0) / h;
    record.sums_at.push_back(between(x, sum, record.sum, a, b));
    record.squares_at.push_back(between(x, squares, record.squares, a * a, b * b));
  }
}

void RunningSums::add_turns(Record& record, std::size_t signal, double t0, double h) {
  Lanes c[polynomial_size], slope[looks + 1];
  combine(values_.data() + signal, records_.size(), c);
  slopes(c, slope);
  for (std::size_t k = 0; k < width; ++k) {
    TurningPoints& turns = record.turns[k];
    turns.take(t0, value(0, signal).lane[k]);
    Curve curve;
    for (std::size_t m = 0; m < polynomial_size; ++m)
      curve.c[m] = c[m].lane[k];
    for (std::size_t i = 0; i < looks; ++i) {
      const double before = slope[i].lane[k], after = slope[i + 1].lane[k];
      if (!(before * after < 0.0))
        continue;
      const double x = turning_place(curve, static_cast<double>(i) / looks,
                                     static_cast<double>(i + 1) / looks, before, after);
      turns.take(t0 + x * h, curve.value(x));
    }
    turns.take(t0 + h, value(stages, signal).lane[k]);
  }
}

std::vector<Measured> RunningSums::of(std::size_t k) const {
  std::vector<Measured> out;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Record& record = records_[i];
    Measured m;
    m.unit = probes_.unit(i);
    m.start = record.start;
    m.duration = std::max(0.0, end_ - record.start);
    if (m.duration > 0.0) {
      m.mean = record.sum.lane[k] / m.duration;
      m.mean_square = record.squares.lane[k] / m.duration;
      m.cosine = record.cosine.lane[k] / m.duration;
      m.sine = record.sine.lane[k] / m.duration;
      const double part = sampling_spans / m.duration;
      double sum = 0.0, squares = 0.0;
      for (std::size_t n = 0; n < sampling_spans; ++n) {
        const bool last = n >= record.sums_at.size();
        const double to = last ? record.sum.lane[k] : record.sums_at[n].lane[k],
                     square = last ? record.squares.lane[k] : record.squares_at[n].lane[k];
        m.span_means.push_back(part * (to - sum));
        m.span_squares.push_back(part * (square - squares));
        sum = to;
        squares = square;
      }
    }
    m.last = value(stages, i).lane[k];
    m.least = record.least.lane[k];
    m.most = record.most.lane[k];
    m.times = record.turns[k].times;
    m.turns = record.turns[k].values;
    out.push_back(std::move(m));
  }
  return out;
}

} // namespace hydrodae::ensemble
