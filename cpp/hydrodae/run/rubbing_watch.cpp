#include "hydrodae/run/rubbing_watch.h"

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/run/first_beyond.h"

namespace hydrodae::run {

std::unique_ptr<RubbingWatch> RubbingWatch::make(system::Regime& regime) {
  std::unique_ptr<RubbingWatch> out(new RubbingWatch(regime));
  return out->view_.lists().empty() ? nullptr : std::move(out);
}

/// Acts on each law, what it sees, and its signals.
template <class Visit> void RubbingWatch::visit(double t, const VectorX& y, Visit&& act) {
  view_.visit(t, y, [&](const View::List& list, const double* in) {
    const system::ElementList& of = s_.elements[list.index];
    const element::Shape& shape = of.laws->shape;
    const double* held = s_.held(of, t, room_);
    held_.assign(held, held + s_.signals[list.index].size()); // inputs as they lag
    for (std::size_t k = 0; k < of.laws->size(); ++k)
      act(list, k, in + k * static_cast<std::size_t>(shape.n_in()),
          held_.data() + k * static_cast<std::size_t>(shape.n_signals));
  });
}

std::optional<double> RubbingWatch::locate(double t0, double t1, int nodes,
                                           const system::Recorder::Interpolant& at) {
  return first_beyond(t0, t1, nodes, [&](double t) {
    at(t, y_, yp_);
    bool changes = false;
    visit(t, y_,
          [&](const View::List& list, std::size_t law, const double* in, const double* held) {
            changes = changes || !list.laws->agrees(law, t, in, held);
          });
    return changes ? 1.0 : -1.0;
  });
}

bool RubbingWatch::settle(double t, const VectorX& y) {
  bool changed = false;
  visit(t, y, [&](const View::List& list, std::size_t law, const double* in, double* held) {
    const element::Elements& laws = *s_.elements[list.index].laws;
    changed = list.laws->settle(law, t, in, held) || changed;
    double* own = s_.signals[list.index].data() + law * laws.inputs.size();
    for (std::size_t i = 0; i < laws.inputs.size(); ++i)
      if (laws.inputs[i].name.empty())
        own[i] = held[i];
    if (!list.laws->agrees(law, t, in, held))
      throw SolverError(t, "stopped at t = " + number_text(t) + " s: rope " +
                               in_quotes(laws.names[law]) +
                               " neither sticks nor slips on the places of its 'friction'");
  });
  return changed;
}

void RubbingWatch::remember(Archive& a) {
  for (const View::List& list : view_.lists())
    for (double& held : s_.signals[list.index])
      a(held);
}

} // namespace hydrodae::run
