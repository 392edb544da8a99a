#include "hydrodae/events/law_events.h"

namespace hydrodae::events {

LawEvents::LawEvents(system::Regime& regime, const VectorX& y)
    : partings_(Partings::make(regime, y)), slips_(Slips::make(regime)),
      kinks_(Kinks::make(regime, y)) {}

std::vector<Source*> LawEvents::sources() const {
  std::vector<Source*> out;
  for (Source* source : {static_cast<Source*>(partings_.get()), static_cast<Source*>(slips_.get()),
                         static_cast<Source*>(kinks_.get())})
    if (source)
      out.push_back(source);
  return out;
}

void LawEvents::accept(double t, const VectorX& y) {
  if (kinks_)
    kinks_->accept(t, y);
}

void LawEvents::part(double t, const VectorX& y) {
  if (partings_)
    partings_->part(t, y);
}

bool LawEvents::settle(double t, const VectorX& y) {
  if (kinks_)
    kinks_->settle(t, y);
  return slips_ && slips_->settle(t, y);
}

void LawEvents::set(Kinks::State state) {
  if (kinks_)
    kinks_->set(std::move(state));
}

} // namespace hydrodae::events
