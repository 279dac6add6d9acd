// The text of what is refused before a run: what was expected, what was found, where, what to do.
#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("spans and times that make no sense are refused", "[errors]") {
  const BallScene scene = leaf();
  const auto run = [&](double begin, double end) {
    return message<ModelError>(
        [&] { simulate(*scene.system, scene.context(1.0, 0.0), {begin, end}); });
  };
  CHECK(run(1.0, 0.0) == "simulate: expected a span with begin <= end, found 1 s to 0 s");
  CHECK(run(0.0, not_a_number) ==
        "simulate: expected a span with begin <= end, found 0 s to nan s");
  Simulator simulator(*scene.system);
  simulator.initialize(scene.context(1.0, 0.0));
  simulator.advance_to(0.2);
  CHECK(message<ModelError>([&] { simulator.advance_to(0.1); }) ==
        "cannot run from t = 0.2 s back to t = 0.1 s; the end has to be later");
}

TEST_CASE("an endless span is refused, or runs until an event ends it", "[errors]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "stop", .guard = [](const At& at) { return at.x[0] - 3.0; }, .terminal = true});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, infinite});
  CHECK(results.status == Status::terminal);
  CHECK(std::abs(results.context.time() - 3.0) < 1e-9);
}

TEST_CASE("an unknown method is refused with the nearest name", "[errors]") {
  const std::string what = message<ModelError>([] { method_from("dopri"); });
  CHECK(contains(what, "unknown ode_solver_method 'dopri'; did you mean 'dopri5'?"));
  CHECK(contains(what, "Known: 'auto', 'dopri5'"));
}

TEST_CASE("an unknown direction is refused with the nearest name", "[errors]") {
  CHECK(contains(message<ModelError>([] { direction_from("positive_then_negative"); }),
                 "did you mean 'positive_then_non_positive'?"));
  CHECK(direction_from("none") == Direction::none);
}

TEST_CASE("a context of another system is refused", "[errors]") {
  const BallScene scene = leaf();
  const Leaf other("other", [](Leaf& l) { declare_ramp(l); });
  CHECK(contains(
      message<ModelError>([&] { simulate(*scene.system, other.create_context(), {0.0, 1.0}); }),
      "the context is not one of this system: expected block 'ball', found 'other'; create it with "
      "system.create_context()"));
}

TEST_CASE("a recorded signal that is unknown, foreign or named twice is refused", "[errors]") {
  const BallScene scene = leaf();
  const Leaf other("other", [](Leaf& l) { declare_ramp(l); });
  const auto record = [&](RecordedSignals signals) {
    return message<ModelError>([&] {
      simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 1.0},
               {.recorded_signals = std::move(signals)});
    });
  };
  CHECK(record({{"x", other.output()}}) ==
        "recorded signal 'x' belongs to block 'other', which is not part of this system");
  CHECK(record({{"y", scene.height}, {"y", scene.height}}) ==
        "two recorded signals are called 'y'");
  CHECK(record({{"y", OutputPort{}}}) == "recorded signal 'y' names no output port");
  const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 0.1},
                                {.recorded_signals = {{"height", scene.height}}});
  CHECK(message<ModelError>([&] { results.output("hight"); }) ==
        "nothing was recorded under 'hight'; did you mean 'height'? Known: 'height'");
}

TEST_CASE("an open input of a leaf that is run is named", "[errors]") {
  const BallOnTable ball;
  CHECK(message<ModelError>([&] { simulate(ball, ball.create_context(), {0.0, 1.0}); }) ==
        "input 'floor' of block 'ball' is not connected; connect it to a block, for example a "
        "Constant");
}

TEST_CASE("a reset of the wrong width says the block, what was expected and what was found",
          "[errors]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_one_shot(0.5, [](const At&, Next& next) { next.set_continuous_state({1.0, 2.0}); });
  });
  CHECK(message<ModelError>([&] {
          simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
        }) ==
        "block 'leaf': expected 1 values for the continuous state, found 2; set all of it at once");
}

TEST_CASE("a continuous signal on a reset trigger is refused with the remedy", "[errors]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& integrator =
      builder.add<Integrator>("integrator", Integrator::Options{.enable_reset = true});
  builder.connect(sine.output(), integrator.input(0)),
      builder.connect(sine.output(), integrator.input(1));
  const Diagram diagram = builder.build();
  CHECK(contains(message<ModelError>([&] { compile(diagram); }), "put a Comparator between them"));
}
