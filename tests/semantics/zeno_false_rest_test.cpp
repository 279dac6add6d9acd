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

namespace {

/// A phase of rate f(t), from 1e6 to 2e6 per second in 50 us, of which the integral is 75. `Way`: how
/// a turn is counted.
enum class Way { wrap, level };

Leaf swept(Way way) {
  return Leaf("swept", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return 1e6 + 2e10 * at.time; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "turn",
         .guard = [=](const At& at) { return at.x[0] - (way == Way::wrap ? 1.0 : at.z[0] + 1.0); },
         .reset_map =
             [=](const At& at, Next& next) {
               if (way == Way::wrap) next.set_continuous_state({at.x[0] - 1.0});
               next.set_discrete_state({at.z[0] + 1.0});
             },
         .direction = Direction::negative_then_non_negative});
  });
}

}  // namespace

TEST_CASE("4.2 firings that follow faster and faster, away from zero, are no rest", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto way = GENERATE(Way::wrap, Way::level);
  const Leaf leaf = swept(way);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 49.9e-6},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  INFO(method << ", " << (way == Way::wrap ? "wrap" : "level"));
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.context.discrete_state()[0] == 74.0);  // 74.8 turns by then
}

TEST_CASE("4.2 a current that a clock switches on, up to a level that falls, is no rest",
          "[semantics]") {
  // i' = 7e6 A/s up to 2 + 3 exp(-k / 12) A, then -5e6 A/s until the next tick, 0.5 us after the last.
  const auto method = GENERATE(from_range(methods));
  constexpr double period = 5e-7;
  const auto level = [](double k) { return 2.0 + 3.0 * std::exp(-k / 12.0); };
  const Leaf leaf("buck", [&](Leaf& l) {
    l.declare_default_mode(0);
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return at.mode == 1 ? 7e6 : -5e6; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) {
          next.set_discrete_state({at.z[0] + 1.0});
          next.set_mode(1);
        },
        period);
    l.declare_zero_crossing({.name = "off",
                             .guard = [=](const At& at) { return at.x[0] - level(at.z[0] - 1.0); },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = 1,
                             .end_mode = 0});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 99.9 * period},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  double i = 1.0;
  std::size_t offs = 0;
  for (int k = 0; k < 100; ++k) {
    const double rest = k < 99 ? period : 0.9 * period, up = (level(k) - i) / 7e6;
    offs += up < rest;
    i = up < rest ? level(k) - 5e6 * (rest - up) : i + 7e6 * rest;
  }
  INFO(method);
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.events.times("off").size() == offs);
  // 100 ticks of some roundings of 5e-5 s, at 7e6 A/s.
  CHECK(std::abs(results.context.continuous_state()[0] - i) <
        100.0 * 8.0 * eps * 5e-5 * 7e6 + 1e-9);
}

TEST_CASE("4.2 some short gaps after a long one are no series", "[semantics]") {
  // A half-wave rectifier: the diode conducts while x' = u' needs a current, x' = -x / RC otherwise.
  // Where it opens, the tolerance lets it close and open again, within 1e-7 s.
  const auto method = GENERATE(from_range(methods));
  for (const double w : {1.0785659124613982, 0.8168925926938857, 3.206742609305109}) {
    for (const double rc : {2.36, 0.9, 0.075}) {
      const auto u = [=](double t) { return std::sin(w * t) + 0.3 * std::sin(2.3 * w * t + 0.4); };
      const auto du = [=](double t) {
        return w * std::cos(w * t) + 0.69 * w * std::cos(2.3 * w * t + 0.4);
      };
      const Leaf leaf("rectifier", [&](Leaf& l) {
        l.declare_default_mode(0);
        l.declare_continuous_state({.initial = vec({0.2}), .ode = [=](const At& at) {
                                      return at.mode == 1 ? du(at.time) : -at.x[0] / rc;
                                    }});
        const auto snap = [=](const At& at, Next& next) {
          next.set_continuous_state({u(at.time)});
        };
        l.declare_zero_crossing({.name = "on",
                                 .guard = [=](const At& at) { return u(at.time) - at.x[0]; },
                                 .reset_map = snap,
                                 .direction = Direction::negative_then_non_negative,
                                 .start_mode = 0,
                                 .end_mode = 1});
        l.declare_zero_crossing({.name = "off",
                                 .guard = [=](const At& at) { return du(at.time) + at.x[0] / rc; },
                                 .reset_map = snap,
                                 .direction = Direction::positive_then_non_positive,
                                 .start_mode = 1,
                                 .end_mode = 0});
      });
      for (const double rtol : {1e-4, 1e-6}) {
        const auto results = simulate(leaf, leaf.create_context(), {0.0, 40.0 / w},
                                      {.rtol = rtol, .ode_solver_method = method});
        INFO(method << ", w " << w << ", rc " << rc << ", rtol " << rtol);
        CHECK(count(results.events, EventKind::zeno_enter) == 0);
      }
    }
  }
}
