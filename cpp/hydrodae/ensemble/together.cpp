#include "hydrodae/ensemble/together.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/ensemble/lanes.h"
#include "hydrodae/ensemble/march.h"
#include "hydrodae/ensemble/probes.h"
#include "hydrodae/session/output.h"

namespace hydrodae::ensemble {

namespace {

struct Group {
  std::vector<std::unique_ptr<Start>> starts;
  std::vector<std::size_t> places; ///< places of its scenes
};

/// Takes a start into the first group with room that it fits.
void join(std::vector<Group>& groups, std::unique_ptr<Start> start, std::size_t place) {
  for (Group& group : groups)
    if (group.starts.size() < width && apart_because(*group.starts[0], *start).empty()) {
      group.starts.push_back(std::move(start));
      group.places.push_back(place);
      return;
    }
  groups.emplace_back();
  groups.back().starts.push_back(std::move(start));
  groups.back().places.push_back(place);
}

} // namespace

std::vector<Answer> simulate_together(const std::vector<const model::Scene*>& scenes,
                                      const std::vector<Wanted>& wanted) {
  std::vector<Answer> out(scenes.size());
  std::vector<Group> groups;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    try {
      const Start* like = groups.empty() ? nullptr : groups[0].starts[0].get();
      auto start = std::make_unique<Start>(*scenes[i], like);
      out[i].alone = alone_because(*start);
      if (out[i].alone.empty())
        out[i].alone = unknown_because(start->regime, wanted);
      if (out[i].alone.empty())
        join(groups, std::move(start), i);
    } catch (const Error& error) {
      out[i].alone = error.what();
    }
  }
  for (const Group& group : groups) {
    const std::vector<Outcome> outcomes = march(group.starts, wanted);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      Answer& answer = out[group.places[k]];
      if (outcomes[k].statistics)
        answer = {attributes(*outcomes[k].statistics), "", outcomes[k].measured};
      else
        answer.alone = outcomes[k].left;
    }
  }
  return out;
}

} // namespace hydrodae::ensemble
