#include "hydrodae/events/kinks.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::events {

namespace {

/// Size of a switching function that counts as zero; usual sizes are one
constexpr double nothing = 1e-13;

} // namespace

Kinks::Kinks(system::Regime& regime) : s_(regime), view_(regime, &element::Elements::has_kinks) {
  std::size_t n = 0;
  for (const View::List& list : view_.lists())
    n += list.laws->size() * static_cast<std::size_t>(list.laws->n_kinks);
  state_.side.assign(n, 0.0);
  now_.resize(n);
}

std::unique_ptr<Kinks> Kinks::make(system::Regime& regime, const VectorX& y) {
  std::unique_ptr<Kinks> out(new Kinks(regime));
  if (out->state_.side.empty())
    return nullptr;
  out->settle(0.0, y);
  return out;
}

void Kinks::look(double t, const VectorX& y, double* out) {
  view_.visit(t, y, [&](const View::List& list, const double* in) {
    list.laws->kinks(t, in, s_.held(s_.elements[list.index], t, room_), out);
    out += list.laws->size() * static_cast<std::size_t>(list.laws->n_kinks);
  });
}

void Kinks::margins(double t, const VectorX& y, const VectorX&, std::span<double> out) {
  look(t, y, out.data());
  for (std::size_t k = 0; k < state_.side.size(); ++k)
    out[k] = state_.side[k] == 0.0 ? 1.0 : state_.side[k] * out[k] + nothing;
}

void Kinks::settle(double t, const VectorX& y) {
  look(t, y, now_.data());
  for (std::size_t k = 0; k < state_.side.size(); ++k)
    if (std::abs(now_[k]) >= nothing)
      state_.side[k] = now_[k] > 0.0 ? 1.0 : -1.0;
  write();
}

/// Writes the sides into the signals of the laws.
void Kinks::write() {
  auto side = state_.side.begin();
  for (const View::List& list : view_.lists()) {
    double* own = s_.signals[list.index].data() + list.laws->side_at;
    for (std::size_t k = 0; k < list.laws->size(); ++k, own += list.laws->shape.n_signals)
      for (int i = 0; i < list.laws->n_kinks; ++i)
        own[i] = *side++;
  }
}

void Kinks::accept(double t, const VectorX& y) {
  if (std::find(state_.side.begin(), state_.side.end(), 0.0) != state_.side.end())
    settle(t, y);
}

void Kinks::set(State state) {
  state_ = std::move(state);
  write();
}

} // namespace hydrodae::events
