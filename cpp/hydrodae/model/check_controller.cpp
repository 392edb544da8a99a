#include "hydrodae/core/text.h"
#include "hydrodae/core/unit.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

void check_arity(const Entry& entry, const Controller& c) {
  const control::Arity a = c.visit([](const auto& one) { return one.arity; });
  const std::string type(c.type());
  if (c->inputs.size() < a.least_inputs || c->inputs.size() > a.most_inputs)
    refuse(entry, "inputs",
           "'inputs' of a " + type + " controller must name " + a.meaning + "; it has " +
               std::to_string(c->inputs.size()));
  if (c->outputs.empty() || (a.outputs > 0 && c->outputs.size() != a.outputs))
    refuse(entry, "outputs",
           a.outputs > 0 ? "a " + type + " controller has one output" : "it has no output");
}

void check_writes_alone(const Scene& scene, const Entry& entry, const Controller& c) {
  for (std::size_t k = 0; k < c->outputs.size(); ++k)
    for (const Controller& other : scene.controllers)
      for (std::size_t i = 0; i < other->outputs.size(); ++i)
        if (signal_of(other->outputs[i]).name == signal_of(c->outputs[k]).name &&
            (&other != &c || i != k))
          refuse(entry, "outputs",
                 in_quotes(signal_of(c->outputs[k]).name) + " is written twice" +
                     (&other != &c ? ", by controller " + in_quotes(other->name) + " too" : ""));
}

} // namespace

void check_controller(const Scene& scene, const Controller& c) {
  const Entry entry{"controller", c->name};
  constexpr double most_samples = 1e9;
  if (scene.solver.end_time > most_samples * c->period)
    refuse(entry, "period",
           "'period' = " + number_text(c->period) + " s takes " +
               number_text(scene.solver.end_time / c->period) +
               " samples until the end of the run (solver.end_time); at most 1e9");
  check_arity(entry, c);
  check_writes_alone(scene, entry, c);
  check_own(entry, c);
}

} // namespace hydrodae::model
