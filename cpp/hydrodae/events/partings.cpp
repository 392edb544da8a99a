#include "hydrodae/events/partings.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::events {

std::unique_ptr<Partings> Partings::make(system::Regime& regime, const VectorX& y) {
  std::unique_ptr<Partings> out(new Partings(regime));
  if (out->view_.lists().empty())
    return nullptr;
  out->visit(0.0, y, [&](std::size_t law, const element::Overload& now, double*) {
    if (now.ratio < 1.0)
      return;
    const std::string& name = out->view_.name(law);
    throw ModelError("force." + name + ".breaking_load",
                     "force " + in_quotes(name) + ": its tension at the start is " +
                         rounded_text(now.ratio) +
                         " times its 'breaking_load': it would part before anything moves");
  });
  return out;
}

/// Acts on each law by its number, its overload, and its signals.
template <class Visit> void Partings::visit(double t, const VectorX& y, Visit&& act) {
  std::size_t number = 0;
  view_.visit(t, y, [&](const View::List& list, const double* in) {
    const element::Shape& shape = s_.elements[list.index].laws->shape;
    for (std::size_t k = 0; k < s_.elements[list.index].laws->size(); ++k) {
      double* held = s_.signals[list.index].data() + k * static_cast<std::size_t>(shape.n_signals);
      act(number++,
          list.laws->overload(k, t, in + k * static_cast<std::size_t>(shape.n_in()), held),
          held + shape.n_signals - element::Parting::n_signals);
    }
  });
}

void Partings::margins(double t, const VectorX& y, const VectorX&, std::span<double> out) {
  visit(t, y, [&](std::size_t law, const element::Overload& now, const double*) {
    out[law] = 1.0 - now.ratio;
  });
}

double Partings::found(const Root& root, const Interpolant& at) {
  constexpr double little = 0.5; // of what is borne
  VectorX y, yp;
  sudden_.clear();
  at(root.before, y, yp);
  bool jumps = false;
  visit(root.before, y, [&](std::size_t law, const element::Overload& now, const double*) {
    jumps = jumps || (law == root.which && now.ratio < little);
  });
  if (!jumps)
    return root.time;
  at(root.time, y, yp);
  visit(root.time, y, [&](std::size_t law, const element::Overload& now, const double*) {
    if (now.ratio >= 1.0)
      sudden_.push_back({law, now.place});
  });
  return root.before;
}

void Partings::part(double t, const VectorX& y) {
  visit(t, y, [&](std::size_t law, const element::Overload& now, double* parted) {
    const auto due =
        std::find_if(sudden_.begin(), sudden_.end(), [&](const Sudden& s) { return s.law == law; });
    if (now.ratio < 1.0 && due == sudden_.end())
      return;
    parted[0] = due == sudden_.end() ? now.place : due->place;
    parted[1] = t;
  });
  sudden_.clear();
}

} // namespace hydrodae::events
