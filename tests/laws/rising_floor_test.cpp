// A floor that rises, falls or shakes under a ball at rest carries it, and lets it go only where it
// falls away faster than gravity.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;

/// A ball whose reset map turns it round relative to the floor: inputs height and velocity.
std::shared_ptr<Leaf> relative_ball(double e) {
  return make_leaf("ball", [=](Leaf& l) {
    l.declare_input_port({.name = "height", .shape = Shape::scalar()});
    l.declare_input_port({.name = "velocity", .shape = Shape::scalar()});
    l.declare_continuous_state({.initial = vec({0.0, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; },
                                .reads = Reads::continuous_state});
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [](const At& at) { return at.x[0] - at.u(0); },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   const double vt = at.u(1);
                                   next.set_continuous_state({at.u(0), vt - e * (at.x[1] - vt)});
                                 },
                             .direction = Direction::positive_then_non_positive});
  });
}

/// Over a floor that rises with `speed` from 1 s on.
Diagram on_a_lift(double e, double speed) {
  DiagramBuilder builder;
  const auto ball = relative_ball(e);
  builder.add(ball);
  auto& height = builder.add<Ramp>("height", RampOptions{.slope = speed, .start_time = 1.0});
  auto& velocity = builder.add<Step>(
      "velocity", StepOptions{.start_value = 0.0, .end_value = speed, .step_time = 1.0});
  builder.connect(height.output(), ball->input("height"));
  builder.connect(velocity.output(), ball->input("velocity"));
  return builder.build();
}

}  // namespace

TEST_CASE("a lift that starts under a ball at rest takes it along", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double speed = GENERATE(0.5, 1e-3);
  for (const double e : {0.0, 0.5}) {
    const Diagram lift = on_a_lift(e, speed);
    const auto results = simulate(lift, lift.create_context(), {0.0, 3.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    // The floor hits the ball with `speed`: it hops with e times that, 2 e speed / (g (1 - e)) in
    // all, then rides. Held states are exact: the reset map says them.
    const auto& x = results.context.continuous_state();
    within(text("lift e=", e), method,
           std::max(std::abs(x[0] - 2.0 * speed), std::abs(x[1] - speed)), 1e-8);
  }
}

TEST_CASE("a floor that rises continuously under a held ball carries it, by every form",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const auto ramp = [] {
    return std::make_shared<Ramp>("floor", RampOptions{.slope = 0.5, .start_time = 1.0});
  };
  for (const BallScene& scene : all_forms_over({.g = g, .e = 0.5}, ramp)) {
    const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 3.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    within(text("ramp under a held ball, ", scene.form), method,
           std::abs(results.context.continuous_state()[0] - 1.0), 1e-8);
  }
}

TEST_CASE("a floor that sinks slowly, slower than free fall, takes the ball down with it",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const Diagram lift = on_a_lift(0.5, -0.5);
  const auto results = simulate(lift, lift.create_context(), {0.0, 3.0},
                                {.ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::reached_end);
  // The floor drops away with 0.5 m/s at once: the ball falls, is there 2 * 0.5 / g = 0.1 s later,
  // bounces and comes to rest on it before 1.4 s.
  const auto& x = results.context.continuous_state();
  within("floor sinks", method, std::max(std::abs(x[0] + 1.0), std::abs(x[1] + 0.5)), 1e-8);
}

TEST_CASE("steps of a floor, up and down, each take a resting ball to the new height",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  // Up at 1 s, 3 s, ...: carried at once. Down at 2 s, 4 s, ...: it falls 0.2 m for 0.2 s, bounces
  // with e = 0.5 and is at rest 3 times as long after it.
  const auto stairs = [] {
    return std::make_shared<Pulse>(
        "floor", PulseOptions{.amplitude = 0.2, .period = 2.0, .phase_delay = 1.0});
  };
  for (const BallScene& scene : all_forms_over({.g = g, .e = 0.5}, stairs)) {
    INFO(scene.form);
    for (const double t : {1.5, 2.9, 3.5, 4.9, 5.5}) {
      const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, t},
                                    {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
      const double height = std::fmod(t, 2.0) > 1.0 && std::fmod(t, 2.0) < 1.75 ? 0.2 : 0.0;
      // A hold after bounces ends within a flight that atol cannot see: some hundred of it; opaque
      // booleans see a floor one rounding lower.
      within(text("stairs ", scene.form), method,
             std::abs(results.context.continuous_state()[0] - height), 1e-8);
    }
  }
}
