#include "hydrodae/run/law_events.h"

namespace hydrodae::run {

std::unique_ptr<LawEvents> LawEvents::make(system::Regime& regime, const VectorX& y) {
  auto out = std::make_unique<LawEvents>();
  out->partings_ = PartingWatch::make(regime, y);
  out->rubs_ = RubbingWatch::make(regime);
  return out->partings_ || out->rubs_ ? std::move(out) : nullptr;
}

std::optional<double> LawEvents::locate(double t0, double t1, int nodes,
                                        const system::Recorder::Interpolant& at) {
  std::optional<double> first;
  if (partings_)
    first = partings_->locate(t0, t1, nodes, at);
  if (rubs_)
    if (const auto event = rubs_->locate(t0, first.value_or(t1), nodes, at))
      first = event;
  return first;
}

void LawEvents::part(double t, const VectorX& y) {
  if (partings_)
    partings_->part(t, y);
}

bool LawEvents::settle(double t, const VectorX& y) { return rubs_ && rubs_->settle(t, y); }

void LawEvents::remember(Archive& a) {
  if (partings_)
    a(*partings_);
  if (rubs_)
    a(*rubs_);
}

} // namespace hydrodae::run
