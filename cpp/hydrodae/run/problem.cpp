#include "hydrodae/run/problem.h"

#include <map>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/sha256.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::run {

struct Problem::Found {
  system::System system;
  system::Pattern pattern;
  Instant start;
};

Problem::Found Problem::find(const model::Scene& scene) {
  Found found{statics::starting_system(scene), {}, {}};
  const system::Regime regime(found.system);
  Instant& start = found.start;
  found.pattern = system::find_pattern(regime);
  start.y = system::initial_state(regime);
  statics::consistent_start(regime, found.pattern, start.y, start.yp);
  system::take_time_scales(found.system, start.y, start.yp);
  return found;
}

Problem::Problem(model::Scene given) : Problem(find(given), std::move(given)) {}

Problem::Problem(Found found, model::Scene&& given)
    : scene(std::move(given)), options(scene.solver), start(std::move(found.start)),
      pattern(std::move(found.pattern)), system(std::move(found.system)) {}

void Problem::begin(const Instant& at) {
  using system::Formulation;
  static const std::map<std::string, Formulation> formulations = {
      {"stabilised", Formulation::stabilised},
      {"index_2", Formulation::index_2},
      {"index_3", Formulation::index_3},
      {"index_1", Formulation::index_1}};
  regime.formulation = formulations.at(options.formulation);
  if (options.baumgarte_time > 0.0)
    regime.baumgarte_rate = 1.0 / options.baumgarte_time;
  if (regime.formulation != Formulation::stabilised || !system.switches.empty())
    pattern = system::find_pattern(regime);
  if (!system::has_past(system))
    return;
  const std::string note = system::limit_steps(system, options);
  if (!note.empty())
    notes.push_back(note);
  history = std::make_unique<system::History>(regime, options);
  history->append(at.t, at.y, at.yp);
  regime.history = history.get();
}

const std::string& Problem::fingerprint() {
  if (fingerprint_.empty())
    fingerprint_ = io::sha256_of_text(std::string(HYDRODAE_VERSION) + '\n' + scene.text + '\n' +
                                      joined(scene.overrides, "\n")) +
                   '\n' + model::text_of_files(scene.files);
  return fingerprint_;
}

void Problem::require_same(const std::string& other) {
  const std::string& own = fingerprint();
  const std::size_t files = own.find('\n') + 1;
  if (other.compare(0, files, own, 0, files) != 0)
    throw CaseError("the state is of another case or version of hydrodae than this run");
  if (const std::string changed = model::changed_file(other.substr(files), own.substr(files));
      !changed.empty())
    throw CaseError("the state is of a run with other inputs than this one: " + changed);
}

} // namespace hydrodae::run
