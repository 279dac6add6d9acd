// Semantics 4.2: what is no Zeno point, and no rest.
#include "support/islands.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("4.2 a sawtooth is never at rest, where its root is a short number too", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double back = GENERATE(0.0, 0.25, 0.5, 0.75, 0.9);
  const Leaf leaf("saw", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return 1.0 - at.x[0]; },
         .reset_map = [=](const At&, Next& next) { next.set_continuous_state({back}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 5.05}, {.ode_solver_method = method});
  INFO(method << ", back to " << back);
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.events.times("full").size() ==
        1 + static_cast<std::size_t>(std::floor(4.05 / (1.0 - back))));
}

TEST_CASE("4.2 an elastic ball is a steady rhythm, however fast, at any tolerance", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-6, 1e-10), height = GENERATE(1e-9, 1.0);
  // The gap is 1 in units of sqrt(8 height / g); g makes it 2.8e-9 s, or 0.9 s below a tolerance of
  // 10 s.
  const double g = height < 1.0 ? 1e9 : 9.81, half = std::sqrt(2.0 * height / g);
  const Leaf ball("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({height, 0.0}),
                                .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing(
        {.name = "impact",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({0.0, -at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results = simulate(ball, ball.create_context(), {0.0, 20.0 * half},
                                {.rtol = rtol,
                                 .atol = 1e-3 * rtol * height,
                                 .ode_solver_method = method,
                                 .zeno_tolerance = height < 1.0 ? 1e-6 : 10.0});
  INFO(method << ", rtol " << rtol << ", height " << height);
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.events.times("impact").size() == 10);
}

TEST_CASE("4.2 a guard faster than its look ahead is a steady rhythm, with any reset map",
          "[semantics]") {
  const bool moves = GENERATE(false, true);
  const Leaf leaf("wave", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "zero",
         .guard = [](const At& at) { return std::sin(1e9 * at.time); },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({moves ? 0.5 : at.x[0]}); }});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1e-6}, {.max_minor_step_size = 1e-10});
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.events.times("zero").size() == 318);  // 1e3 / pi, without the zero at the start
}

TEST_CASE("4.2 a hold leaves no speed: a ball that keeps its height does not rest in flight",
          "[semantics]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::automatic);
  const double floor = GENERATE(0.0, -7.0, 1e3), t0 = GENERATE(0.0, -3.0);
  constexpr double g = 10.0, e = 0.3;
  const Leaf ball("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({floor + 1.545, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [=](const At& at) { return at.x[0] - floor; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.x[0], -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results = simulate(ball, ball.create_context(t0), {t0, t0 + 3.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  INFO(method << ", floor " << floor << ", t0 " << t0);
  // The last flight that rounding shows rises by 16 roundings of the height, twice over.
  const double rise = 32.0 * eps * std::abs(floor) + 1e-15;
  CHECK(std::abs(results.context.continuous_state()[1]) < std::sqrt(2.0 * g * rise) + g * 1e-6);
  CHECK(std::abs(results.context.continuous_state()[0] - floor) < 1e-9);
}

namespace {

/// x' = -t. Its guard starts at zero, and its slope is zero there: it fires at once. Its reset map
/// writes no continuous state.
std::shared_ptr<Leaf> slides() {
  return make_leaf("slides", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return -at.time; }});
    l.declare_continuous_state_output("x");
    l.declare_discrete_state({.initial = vec({0.0})});
    l.declare_zero_crossing(
        {.name = "count",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); },
         .direction = Direction::positive_then_non_positive});
  });
}

/// A block that reads the block that slides and the ball, and changes neither.
std::shared_ptr<Leaf> reader(const std::string& kind) {
  return make_leaf("reader", [&](Leaf& l) {
    l.declare_input_port({.name = "x", .shape = Shape::scalar()});
    l.declare_input_port({.name = "ball", .shape = Shape::of(2)});
    const auto sum = [](const At& at) { return at.u(0) + at.u[1][0]; };
    if (kind == "output") l.declare_output_port({.name = "sum", .calc = sum});
    if (kind == "state") l.declare_continuous_state({.initial = vec({0.0}), .ode = sum});
    if (kind == "monitor")
      l.declare_zero_crossing(
          {.name = "low", .guard = [=](const At& at) { return sum(at) + 0.25; }});
  });
}

Diagram slides_beside_ball(const std::string& kind) {
  DiagramBuilder builder;
  const auto slider = slides();
  const auto ball = std::make_shared<Ball>(BallOptions{}, "ball");
  builder.add(slider), builder.add(ball);
  if (kind == "nothing") return builder.build();
  const auto reads = reader(kind);
  builder.add(reads);
  builder.connect(slider->output(0), reads->input(0));
  builder.connect(ball->output(0), reads->input(1));
  if (kind == "output") builder.export_output(reads->output(0), "sum");
  return builder.build();
}

}  // namespace

TEST_CASE("4.2 a reset of a block that does not change a guard puts nothing to rest, whoever reads",
          "[semantics]") {
  // The ball on the floor is reset at the instant of `count`, and rests. The block that slides does
  // not.
  const auto method = GENERATE(from_range(methods));
  const std::string kind = GENERATE("nothing", "output", "monitor", "state");
  const Diagram scene = slides_beside_ball(kind);
  Eigen::VectorXd x0 = scene.create_context().continuous_state();
  x0.setZero();
  const Results results =
      simulate(scene, scene.create_context().with_continuous_state(x0), {0.0, 1.0},
               {.rtol = 1e-10, .atol = 1e-10, .ode_solver_method = method});
  INFO(method << ", reader with " << kind);
  // x(1) = -1/2. Each of fewer than a thousand steps may err by the tolerance.
  CHECK(std::abs(results.context.continuous_state()[0] + 0.5) < 1e-7);
  CHECK(results.context.discrete_state()[0] == 1.0);
  for (std::size_t i = 0; i < results.events.size(); ++i)
    CHECK((results.events[i].block != "slides" ||
           results.events[i].kind == EventKind::zero_crossing));
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
}

TEST_CASE("4.2 two blocks come to rest at one instant, each by its own reset", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  DiagramBuilder builder;
  builder.add(std::make_shared<Ball>(BallOptions{}, "a"));
  builder.add(std::make_shared<Ball>(BallOptions{}, "b"));
  const Diagram scene = builder.build();
  const Results results =
      simulate(scene, scene.create_context().with_continuous_state(Eigen::VectorXd::Zero(4)),
               {0.0, 1.0}, {.ode_solver_method = method});
  CHECK(results.context.continuous_state().isZero());
  CHECK(count(results.events, EventKind::zeno_enter) == 2);
}
