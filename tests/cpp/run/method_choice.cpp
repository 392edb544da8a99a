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

TEST_CASE("many steps in a row that are short against the motion call for another method") {
  MethodChoice choice = chosen();
  for (int k = 0; k < 39; ++k)
    choice.accept(1e-3, 10.0, true, 0.0);
  CHECK_FALSE(choice.labours(3.0));
  choice.accept(1e-9, 10.0, false, 0.0); // cut short: no evidence
  CHECK_FALSE(choice.labours(3.0));
  choice.accept(1e-3, 10.0, true, 0.0);
  CHECK(choice.labours(3.0));
  choice.next(*choice.labours(3.0));
  CHECK(in_words(choice) ==
        "auto: explicit_rk (nothing is stiff), radau from t = 3 s because 40 steps of explicit_rk "
        "in a row were shorter than 0.02 rad of the motion");
  CHECK_FALSE(choice.labours(3.0));
  choice = chosen();
  for (int k = 0; k < 200; ++k)
    choice.accept(k % 39 == 38 ? 0.1 : 1e-3, 10.0, true, 0.0); // now and then a long one
  CHECK_FALSE(choice.labours(3.0));
}

TEST_CASE("explicit_rk takes turns where it needs less than half of the operations") {
  const auto make_steps = [](MethodChoice& choice, int n, double each) {
    double operations = 0.0;
    for (int k = 0; k < n; ++k)
      choice.accept(0.01, 1.0, true, operations += each);
  };
  const auto fastest = [] { return 100.0; }; // stable up to steps of 0.05 s
  const double of_step = 1e3;
  MethodChoice choice(MethodOrder{{"radau", "ida"}, "it is stiff", true});
  const auto weigh = [&](double t) {
    const std::optional<MethodChange> change = choice.weigh(t, of_step, fastest);
    REQUIRE(change);
    choice.next(*change);
  };
  make_steps(choice, 10, 5e3);
  CHECK_FALSE(choice.weighs());
  make_steps(choice, 1, 5e3);
  CHECK(choice.weighs());
  choice = MethodChoice(MethodOrder{{"radau", "ida"}, "it is stiff", true});
  make_steps(choice, 11, 1.9e3);
  CHECK_FALSE(choice.weigh(1.0, of_step, fastest)); // 1.9 times as many
  make_steps(choice, 11, 5e3);
  CHECK(choice.weighs());
  CHECK_FALSE(
      choice.weigh(1.0, of_step, [] { return 2000.0; })); // its steps would be 0.0025 s long
  make_steps(choice, 11, 5e3);
  weigh(1.0);
  CHECK(in_words(choice) ==
        "auto: radau (it is stiff), explicit_rk from t = 1 s because 10 steps of "
        "radau took 5 times the operations that explicit_rk needs");
  CHECK(choice.method() == "explicit_rk");
  const auto turn = [&] {
    int steps = 0;
    for (; !choice.returns(2.0); ++steps)
      choice.accept(1e-9, 1.0, true, 0.0);
    CHECK_FALSE(choice.labours(3.0));
    const MethodChange change = *choice.returns(2.0);
    CHECK(change.reason ==
          "explicit_rk has made the " + std::to_string(steps) + " steps of its turn");
    CHECK(change.time == 2.0);
    choice.next(change);
    CHECK(choice.method() == "radau");
    return steps;
  };
  CHECK(turn() == 500); // ten times 10 steps of 5
  make_steps(choice, 11, 5e3);
  weigh(3.0);
  CHECK(turn() == 1000); // twice as long, as radau did no better at once
  make_steps(choice, 11, 1e3);
  CHECK_FALSE(choice.weigh(1.0, of_step, fastest));
  make_steps(choice, 11, 5e3);
  weigh(4.0);
  CHECK(turn() == 500);
  stop(choice, 5.0, "no step");
  CHECK(choice.method() == "ida");

  MethodChoice other(MethodOrder{{"radau", "ida"}, "it is stiff", true});
  other.set(choice.state());
  CHECK(in_words(other) == in_words(choice));
  CHECK(other.method() == "ida");
}

TEST_CASE("a choice is saved and restored") {
  MethodChoice choice = chosen(), other = chosen();
  stop(choice, 1.5, "Größe");
  choice.accept(1e-3, 10.0, true, 0.0);
  other.set(choice.state());
  CHECK(in_words(other) == in_words(choice));
  MethodChoice named("radau");
  CHECK_THROWS_AS(named.set(choice.state()), hydrodae::Error);
}
