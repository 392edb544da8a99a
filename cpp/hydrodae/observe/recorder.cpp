#include "hydrodae/observe/recorder.h"

namespace hydrodae::observe {

using namespace system;

Recorder::Recorder(const Regime& system, measure::Measure& measure)
    : s_(system), measure_(measure) {
  make_channels();
}

void Recorder::sample(double t, const Interpolant& at, std::span<double> row) {
  at(t, y_, yp_);
  measure_.observer().observe(t, y_, yp_);
  fill(t, row);
}

void Recorder::look(const VectorX& y, const VectorX& yp, std::span<double> row) {
  y_ = y;
  yp_ = yp;
  measure_.observer().observe(measure_.start(), y_, yp_);
  fill(measure_.start(), row);
}

} // namespace hydrodae::observe
