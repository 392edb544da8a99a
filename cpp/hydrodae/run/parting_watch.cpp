#include "hydrodae/run/parting_watch.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/run/first_beyond.h"

namespace hydrodae::run {

std::unique_ptr<PartingWatch> PartingWatch::make(system::Regime& regime, const VectorX& y) {
  std::unique_ptr<PartingWatch> out(new PartingWatch(regime));
  if (out->view_.lists().empty())
    return nullptr;
  out->visit(
      0.0, y, [&](const View::List& list, std::size_t law, const element::Overload& now, double*) {
        if (now.ratio < 1.0)
          return;
        const std::string& name = regime.elements[list.index].laws->names[law];
        throw ModelError("force." + name + ".breaking_load",
                         "force " + in_quotes(name) + ": its tension at the start is " +
                             rounded_text(now.ratio) +
                             " times its 'breaking_load': it would part before anything moves");
      });
  return out;
}

/// Acts on each law, its overload, and its signals.
template <class Visit> void PartingWatch::visit(double t, const VectorX& y, Visit&& act) {
  view_.visit(t, y, [&](const View::List& list, const double* in) {
    const element::Shape& shape = s_.elements[list.index].laws->shape;
    for (std::size_t k = 0; k < s_.elements[list.index].laws->size(); ++k) {
      double* held = s_.signals[list.index].data() + k * static_cast<std::size_t>(shape.n_signals);
      act(list, k, list.laws->overload(k, t, in + k * static_cast<std::size_t>(shape.n_in()), held),
          held + shape.n_signals - element::Parting::n_signals);
    }
  });
}

/// Of what is loaded most, over what it bears [-].
double PartingWatch::largest_ratio(double t, const VectorX& y) {
  double out = 0.0;
  visit(t, y, [&](const View::List&, std::size_t, const element::Overload& now, const double*) {
    out = std::max(out, now.ratio);
  });
  return out;
}

std::optional<double> PartingWatch::locate(double t0, double t1, int nodes,
                                           const system::Recorder::Interpolant& at) {
  constexpr double just = 1e-9, little = 0.5; // of the step, of what is borne
  sudden_.clear();
  const auto beyond = first_beyond(t0, t1, nodes, [&](double t) {
    at(t, y_, yp_);
    return largest_ratio(t, y_) - 1.0;
  });
  if (!beyond)
    return beyond;
  const double before = std::max(t0, *beyond - just * (t1 - t0));
  at(before, y_, yp_);
  if (largest_ratio(before, y_) > little)
    return beyond;
  at(*beyond, y_, yp_);
  find_sudden(*beyond, y_);
  return before;
}

void PartingWatch::find_sudden(double t, const VectorX& y) {
  visit(t, y,
        [&](const View::List& list, std::size_t law, const element::Overload& now, const double*) {
          if (now.ratio >= 1.0)
            sudden_.push_back({list.index, law, now.place});
        });
}

void PartingWatch::part(double t, const VectorX& y) {
  visit(t, y,
        [&](const View::List& list, std::size_t law, const element::Overload& now, double* parted) {
          const auto due = std::find_if(sudden_.begin(), sudden_.end(), [&](const Sudden& s) {
            return s.list == list.index && s.law == law;
          });
          if (now.ratio < 1.0 && due == sudden_.end())
            return;
          parted[0] = due == sudden_.end() ? now.place : due->place;
          parted[1] = t;
        });
  sudden_.clear();
}

void PartingWatch::remember(Archive& a) {
  for (const View::List& list : view_.lists()) {
    const element::Shape& shape = s_.elements[list.index].laws->shape;
    std::vector<double>& held = s_.signals[list.index];
    for (std::size_t end = static_cast<std::size_t>(shape.n_signals); end <= held.size();
         end += static_cast<std::size_t>(shape.n_signals))
      for (std::size_t k = end - element::Parting::n_signals; k < end; ++k)
        a(held[k]);
  }
}

} // namespace hydrodae::run
