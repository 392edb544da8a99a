#pragma once
/// Inputs of laws of one kind at an instant, for sources that watch them inside a step.

#include <vector>

#include "hydrodae/system/elements.h"

namespace hydrodae::events {

template <class Laws> class LawView {
public:
  struct List {
    std::size_t index; ///< in the regime's elements
    const Laws* laws;
  };

  /// The lists of laws of this kind that say `asked` of themselves.
  LawView(system::Regime& regime, bool (Laws::*asked)() const) : s_(regime), ws_(regime) {
    for (std::size_t i = 0; i < regime.elements.size(); ++i)
      if (const auto* laws = dynamic_cast<const Laws*>(regime.elements[i].laws.get());
          laws && (laws->*asked)())
        lists_.push_back({i, laws});
  }

  const std::vector<List>& lists() const { return lists_; }

  /// Number of laws in all lists.
  std::size_t size() const {
    std::size_t n = 0;
    for (const List& list : lists_)
      n += s_.elements[list.index].laws->size();
    return n;
  }

  /// Name of a law by its number among them.
  const std::string& name(std::size_t law) const {
    auto list = lists_.begin();
    for (; law >= s_.elements[list->index].laws->size(); ++list)
      law -= s_.elements[list->index].laws->size();
    return s_.elements[list->index].laws->names[law];
  }

  /// Acts on each list and the inputs of its laws, one after the other, in the state y at t [s].
  template <class Act> void visit(double t, const VectorX& y, Act&& act) {
    if (yp_.size() != y.size())
      yp_ = VectorX::Zero(y.size());
    ws_.time = t;
    system::unpack<double>(s_, y.data(), yp_.data(), ws_.bodies);
    for (const List& list : lists_) {
      system::ElementScratch<double>& scratch = ws_.elements[list.index];
      system::gather<double>(s_, s_.elements[list.index], ws_, y.data(), scratch);
      act(list, scratch.in.data());
    }
  }

private:
  system::Regime& s_;
  system::Workspace<double> ws_;
  std::vector<List> lists_;
  VectorX yp_; ///< zero: laws see no accelerations
};

} // namespace hydrodae::events
