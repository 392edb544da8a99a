#include "hydrodae/run/method_choice.h"

#include <doctest/doctest.h>

#include "support.h"

using hydrodae::SolverError;
using hydrodae::run::in_words;
using hydrodae::run::MethodChange;
using hydrodae::run::MethodChoice;
using hydrodae::run::MethodOrder;
using hydrodae::run::order_methods;
using hydrodae::run::SceneTraits;

namespace {

const std::vector<std::string> explicit_first = {"explicit_rk", "radau", "ida"};
const std::vector<std::string> radau_first = {"radau", "explicit_rk", "ida"};
const std::vector<std::string> of_stiff = {"radau", "ida"};

/// Ten seconds of something that moves by a radian a second, ten times as slow as its equations.
SceneTraits plain() {
  SceneTraits out;
  out.fastest_rate = 10.0;
  out.motion_rate = 1.0;
  out.end_time = 10.0;
  return out;
}

MethodChoice chosen() { return MethodChoice(MethodOrder{explicit_first, "nothing is stiff"}); }

/// Goes on after an error of the method at work.
void stop(MethodChoice& choice, double time, const std::string& what,
          const std::string& details = "", const std::string& advice = "",
          MethodChange::Cause cause = MethodChange::Cause::stop) {
  choice.next(choice.after(
      SolverError(time, {hydrodae::Reason::step, what, "", {}, advice, details}), cause));
}

} // namespace

TEST_CASE("a scene without stiff parts begins with explicit_rk") {
  CHECK(order_methods(plain()).methods == explicit_first);
  CHECK(order_methods(plain()).reason == "nothing is stiff");
}

TEST_CASE("what is much faster than the motion takes an implicit method") {
  SceneTraits traits = plain();
  traits.fastest_rate = 60.0;
  CHECK(order_methods(traits).methods == of_stiff);
  traits.motion_rate = 2.0; // it moves as fast itself
  CHECK(order_methods(traits).methods == explicit_first);
  traits.fastest_rate = INFINITY; // no accelerations
  CHECK(order_methods(traits).methods == of_stiff);
  traits.fastest_rate = NAN;
  CHECK(order_methods(traits).methods == of_stiff);
}

TEST_CASE("where an evaluation is dear, radau evaluates least") {
  SceneTraits traits = plain();
  traits.costly = "a drive of Python";
  CHECK(order_methods(traits).methods == radau_first);
  CHECK(order_methods(traits).reason == "a drive of Python is expensive to evaluate");
}

TEST_CASE("a long run without damping takes the method whose errors are smallest") {
  SceneTraits traits = plain();
  traits.end_time = 3000.0;
  CHECK(order_methods(traits).methods == radau_first);
  traits.damped = true;
  CHECK(order_methods(traits).methods == explicit_first);
}

TEST_CASE("methods follow one another, each with the reason of the last") {
  MethodChoice choice = chosen();
  CHECK(choice.chosen());
  CHECK(in_words(choice) == "auto: explicit_rk (nothing is stiff)");
  stop(choice, 1.5, "the step has become too short", "\n  worst");
  CHECK(choice.method() == "radau");
  CHECK(in_words(choice) == "auto: explicit_rk (nothing is stiff), radau from t = 1.5 s because "
                            "explicit_rk gave up: the step has become too short");
  stop(choice, 2.0, "no finite accelerations");
  CHECK(choice.method() == "ida");
  CHECK_FALSE(choice.more());
}

TEST_CASE("a step that a guard refuses is no failure of the method itself") {
  MethodChoice choice = chosen();
  stop(choice, 1.5, "the energy balance is off", "", "", MethodChange::Cause::guard);
  CHECK(in_words(choice) ==
        "auto: explicit_rk (nothing is stiff), radau from t = 1.5 s because a step of explicit_rk "
        "was refused: the energy balance is off");
}

TEST_CASE("where no method is left, the error tells of all") {
  MethodChoice choice = chosen();
  stop(choice, 1.5, "first reason", "\n  no use", "advice");
  stop(choice, 1.6, "second reason");
  std::string told;
  try {
    stop(choice, 1.7, "third reason", "\n  worst equations", "take radau");
  } catch (const SolverError& error) {
    told = error.what();
    CHECK(error.time == 1.7);
  }
  CHECK(told == "stopped at t = 1.7 s: no method of \"auto\" goes on: explicit_rk at t = 1.5 s: "
                "first reason; radau at t = 1.6 s: second reason; ida at t = 1.7 s: third reason\n"
                "  worst equations");
}

namespace {

constexpr double of_step = 1e3; // operations of a step of explicit_rk

/// A choice with the operations of a run so far.
struct Run {
  MethodChoice choice;
  double operations = 0.0;

  explicit Run(MethodOrder order) : choice(std::move(order)) {}

  /// Eleven steps, which are weighed; fastest rate of the equations [1/s].
  bool changes(double h, double each, double fastest = 100.0, bool own = true) {
    for (int k = 0; k < 11; ++k)
      choice.accept(h, own, operations += each);
    REQUIRE(choice.weighs());
    const auto change = choice.weigh(2.0, of_step, [&] { return fastest; });
    if (change)
      choice.next(*change);
    return change.has_value();
  }
};

Run stiff() { return Run({{"radau", "ida"}, "it is stiff", true}); }
Run plain_run() { return Run({explicit_first, "nothing is stiff", true}); }

} // namespace

TEST_CASE("explicit_rk is tried where radau needs more than 1.5 times its operations") {
  Run run = stiff();
  run.choice.accept(0.01, true, 1.0);
  CHECK_FALSE(run.choice.weighs()); // eleven steps bound ten
  run = stiff();
  CHECK_FALSE(run.changes(0.01, 1.4 * of_step));
  run = stiff();
  CHECK_FALSE(run.changes(0.01, 5.0 * of_step, 2000.0)); // its steps would be 0.0025 s long
  run = stiff();
  CHECK(run.changes(0.01, 5.0 * of_step));
  CHECK(in_words(run.choice) ==
        "auto: radau (it is stiff), explicit_rk from t = 2 s because 10 steps of "
        "radau took 5 times the operations that explicit_rk needs");
  stop(run.choice, 5.0, "no step"); // in the trial
  CHECK(run.choice.method() == "radau");
  for (int k = 0; k < 20; ++k)
    run.choice.accept(0.01, true, 1e6 * k);
  CHECK_FALSE(run.choice.weighs()); // explicit_rk is given up
  stop(run.choice, 6.0, "no step");
  CHECK(run.choice.method() == "ida");
}

TEST_CASE("radau is tried where something else than its error bounds the steps of explicit_rk") {
  Run run = plain_run();
  CHECK_FALSE(run.changes(0.03, of_step)); // 3 over the fastest rate
  run = plain_run();
  CHECK(run.changes(0.045, of_step)); // near the limit of stability
  CHECK(run.choice.method() == "radau");
  run = plain_run();
  CHECK(run.changes(0.001, of_step, 100.0, false)); // instants of the scene
  run = Run({explicit_first, "nothing is stiff"});
  for (int k = 0; k < 20; ++k)
    run.choice.accept(0.045, true, 1e3 * k);
  CHECK_FALSE(run.choice.weighs()); // a choice that does not weigh
}

TEST_CASE("the method of a trial stays where it costs less, and returns where it costs more") {
  Run run = plain_run();
  REQUIRE(run.changes(0.045, of_step));
  CHECK_FALSE(run.changes(0.1, 9.0 * of_step)); // its first steps do not count
  CHECK_FALSE(run.changes(0.45, 2.0 * of_step));
  CHECK(run.choice.method() == "radau");
  run = plain_run();
  REQUIRE(run.changes(0.045, of_step));
  CHECK_FALSE(run.changes(0.045, 4.0 * of_step));
  CHECK(run.changes(0.045, 4.0 * of_step));
  CHECK(run.choice.method() == "explicit_rk");
  // The next trials wait for ten, then for twenty times the operations of one: 22 steps of 4.
  const auto windows = [&] {
    int n = 1;
    while (!run.changes(0.045, of_step))
      ++n;
    run.changes(0.045, 4.0 * of_step);
    REQUIRE(run.changes(0.045, 4.0 * of_step));
    return n;
  };
  CHECK(windows() == 80);
  CHECK(windows() == 160);
  MethodChoice other(MethodOrder{explicit_first, "nothing is stiff", true});
  other.set(run.choice.state());
  CHECK(in_words(other) == in_words(run.choice));
}

TEST_CASE("a choice is saved and restored") {
  MethodChoice choice = chosen(), other = chosen();
  stop(choice, 1.5, "Größe");
  choice.accept(1e-3, true, 0.0);
  other.set(choice.state());
  CHECK(in_words(other) == in_words(choice));
  MethodChoice named("radau");
  CHECK_THROWS_AS(named.set(choice.state()), hydrodae::Error);
}
