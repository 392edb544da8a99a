#include "hydrodae/events/slips.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::events {

std::unique_ptr<Slips> Slips::make(system::Regime& regime) {
  std::unique_ptr<Slips> out(new Slips(regime));
  return out->view_.lists().empty() ? nullptr : std::move(out);
}

/// Acts on each law, what it sees, and its signals.
template <class Visit> void Slips::visit(double t, const VectorX& y, Visit&& act) {
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

void Slips::margins(double t, const VectorX& y, const VectorX&, std::span<double> out) {
  double* next = out.data();
  visit(t, y, [&](const View::List& list, std::size_t law, const double* in, const double* held) {
    list.laws->rubs(law, t, in, held, next);
    next += list.laws->n_rubs();
  });
}

bool Slips::settle(double t, const VectorX& y) {
  bool changed = false;
  visit(t, y, [&](const View::List& list, std::size_t law, const double* in, double* held) {
    const element::Elements& laws = *s_.elements[list.index].laws;
    changed = list.laws->settle(law, t, in, held) || changed;
    double* own = s_.signals[list.index].data() + law * laws.inputs.size();
    for (std::size_t i = 0; i < laws.inputs.size(); ++i)
      if (laws.inputs[i].name.empty())
        own[i] = held[i];
    rubs_.resize(static_cast<std::size_t>(list.laws->n_rubs()));
    list.laws->rubs(law, t, in, held, rubs_.data());
    if (*std::min_element(rubs_.begin(), rubs_.end()) < 0.0)
      throw SolverError(t, {Reason::friction,
                            "rope " + in_quotes(laws.names[law]) +
                                " neither sticks nor slips on the places of its 'friction'",
                            "forces/" + laws.names[law]});
  });
  return changed;
}

} // namespace hydrodae::events
