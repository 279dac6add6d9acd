// A leaf on a Zeno hold stands still, but the rest of it lives: ticks count, guards on time fire,
// terminal ones end the run, a change of mode lets it go.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 10.0;

/// A ball at rest on the floor from t = 0; `more` declares what else it has.
template <class Declare>
std::shared_ptr<Leaf> resting_ball(Declare more) {
  return make_leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           const double lift = at.mode == 1 ? 2.0 * g : 0.0;
           xdot << at.x[1], lift - g;
         }});
    l.declare_default_mode(0);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    more(l);
  });
}

Results run(const Form& form, Method method, double end) {
  return simulate(
      *form.system, form.context(), {0.0, end},
      {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method, .throw_errors = false});
}

double late(const At& at) { return at.time - 1.0; }

}  // namespace

TEST_CASE("ticks and guards on time that write no continuous state happen on a hold, which goes on",
          "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const auto ball = resting_ball([](Leaf& l) {
    l.declare_periodic_update(count_up, 0.1, 0.05, "tick");  // off the alarm
    l.declare_zero_crossing({.name = "alarm", .guard = late, .reset_map = count_up});
    l.declare_zero_crossing({.name = "look", .guard = [](const At& at) { return at.time - 1.5; }});
  });
  for (const Form& form : forms(ball)) {
    const auto results = run(form, method, 2.02);
    INFO(form.name << ", method " << method);
    CHECK(results.status == Status::reached_end);
    CHECK(results.context.discrete_state()[0] == 21.0);
    CHECK(results.context.continuous_state() == vec({0.0, 0.0}));
    CHECK(count(results.events, EventKind::zeno_enter) == 1);
    CHECK(count(results.events, EventKind::zeno_release) == 0);
    within(text("alarm on a hold, ", form.name), method,
           worst(results.events.times("alarm"), {1.0}), 400.0 * eps);
    within(text("monitor on a hold, ", form.name), method,
           worst(results.events.times("look"), {1.5}), 400.0 * eps);
  }
}

TEST_CASE("a terminal guard ends a run on a hold", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const auto ball = resting_ball(
      [](Leaf& l) { l.declare_zero_crossing({.name = "end", .guard = late, .terminal = true}); });
  for (const Form& form : forms(ball)) {
    const auto results = run(form, method, 2.0);
    CHECK(results.status == Status::terminal);
    within(text("terminal on a hold, ", form.name), method, std::abs(results.context.time() - 1.0),
           400.0 * eps);
  }
}

// What comes out, here and below: the hold goes on to the end, with whatever state was written.
TEST_CASE("a change of mode that lifts the ball ends its hold", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const bool by_tick = GENERATE(false, true);
  const auto ball = resting_ball([=](Leaf& l) {
    if (by_tick)
      l.declare_one_shot(1.0, [](const At&, Next& next) { next.set_mode(1); }, "lift");
    else
      l.declare_zero_crossing({.name = "lift", .guard = late, .start_mode = 0, .end_mode = 1});
  });
  for (const Form& form : forms(ball)) {
    const auto results = run(form, method, 2.0);
    // From 1 s on it is pulled up with g.
    const auto& x = results.context.continuous_state();
    within(text("lifted off a hold ", by_tick ? "by a tick, " : "by a guard, ", form.name), method,
           std::max(std::abs(x[0] - 0.5 * g), std::abs(x[1] - g)),
           g * (allowed(method, 1e-9, 1e-11, 1.0) + 400.0 * eps));
  }
}

TEST_CASE("a guard on time that throws the ball up ends its hold", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const auto ball = resting_ball([](Leaf& l) {
    l.declare_zero_crossing({.name = "kick", .guard = late, .reset_map = [](const At&, Next& next) {
                               next.set_continuous_state({0.0, 10.0});
                             }});
  });
  for (const Form& form : forms(ball)) {
    const auto results = run(form, method, 2.0);
    const auto& x = results.context.continuous_state();
    within(text("thrown off a hold, ", form.name), method,
           std::max(std::abs(x[0] - 5.0), std::abs(x[1])),
           g * (allowed(method, 1e-9, 1e-11, 10.0) + 400.0 * eps));
  }
}

TEST_CASE("a force that comes on lifts a ball at rest off its hold", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const auto ball = make_leaf("ball", [](Leaf& l) {
    const int in = l.declare_input_port({.name = "thrust", .shape = Shape::scalar()});
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], at.u(in) - g; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  DiagramBuilder builder;
  builder.add(ball);
  auto& thrust = builder.add<Step>("thrust", StepOptions{.end_value = 2.0 * g, .step_time = 1.0});
  builder.connect(thrust.output(), ball->input());
  const Form form{std::make_shared<Diagram>(builder.build()), "diagram"};
  const auto results = run(form, method, 2.0);
  const auto& x = results.context.continuous_state();
  within("lifted off a hold by a force", method,
         std::max(std::abs(x[0] - 0.5 * g), std::abs(x[1] - g)),
         g * (allowed(method, 1e-9, 1e-11, 1.0) + 400.0 * eps));
}
