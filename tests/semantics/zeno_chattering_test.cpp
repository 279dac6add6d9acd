// Semantics 4.7: scenes whose events go on without time. None hangs, none slips through unnoticed.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = f(x, on), on while guard(x, t) > 0.
template <class Guard, class Flow>
Leaf relay(const Eigen::VectorXd& start, Guard guard, Flow flow, std::string name = "relay") {
  return Leaf(std::move(name), [&](Leaf& l) {
    const auto on = l.declare_relation({.name = "on", .guard = guard});
    l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                  flow(at, at.relation(on), xdot);
                                }});
  });
}

/// x' = -sign(x).
Leaf falling(std::string name, double start) {
  return relay(
      vec({start}), [](const At& at) { return at.x[0]; },
      [](const At&, bool on, VectorRef xdot) { xdot << (on ? -1.0 : 1.0); }, std::move(name));
}

void chatters(const System& system, Method method, double zeno_tolerance = 1e-6) {
  const auto results = simulate(
      system, system.create_context(), {0.0, 20.0},
      {.ode_solver_method = method, .zeno_tolerance = zeno_tolerance, .throw_errors = false});
  INFO("method " << method << ", t = " << results.context.time() << ": " << results.message);
  CHECK(results.status == Status::chattering);
  CHECK(results.events.size() < 10000);
}

}  // namespace

TEST_CASE("4.7 sliding on a surface that moves, in the plane, or under friction chatters",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto moving = relay(
      vec({1.0}), [](const At& at) { return at.x[0] - std::sin(at.time); },
      [](const At&, bool on, VectorRef xdot) { xdot << (on ? -3.0 : 3.0); });
  const auto plane = relay(
      vec({1.0, 0.5}), [](const At& at) { return at.x[0] + 0.3 * at.x[1]; },
      [](const At& at, bool on, VectorRef xdot) { xdot << at.x[1], (on ? -2.0 : 2.0); });
  const auto friction = relay(
      vec({0.0, 1.0}), [](const At& at) { return at.x[1]; },
      [](const At& at, bool on, VectorRef xdot) {
        xdot << at.x[1], (on ? -1.0 : 1.0) - 0.2 * at.x[0];
      });
  for (const Leaf* leaf : {&moving, &plane, &friction}) chatters(*leaf, method);
}

TEST_CASE("4.7 two sliding blocks chatter", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  DiagramBuilder builder;
  builder.add(std::make_shared<Leaf>(falling("first", 0.5)));
  builder.add(std::make_shared<Leaf>(falling("second", 0.6)));
  chatters(builder.build(), method);
}

TEST_CASE("4.7 sliding beside a clock that ticks when the surface is reached chatters too",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  DiagramBuilder builder;
  builder.add(std::make_shared<Leaf>(falling("sliding", 0.5)));
  builder.add<Leaf>("clock", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(count_up, 1e-3);
  });
  chatters(builder.build(), method);
}

TEST_CASE("4.7 switching that accumulates is not slipped through where no monitor holds it",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  // Two leaking tanks and one hose; modes only. All switching accumulates at 2 s, with both empty.
  const Leaf tanks("tanks", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 1.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << (at.mode == 0 ? 1.0 : -2.0), (at.mode == 1 ? 1.0 : -2.0);
         }});
    l.declare_default_mode(0);
    for (const int i : {0, 1}) {
      l.declare_zero_crossing({.name = text("empty_", i),
                               .guard = [=](const At& at) { return at.x[i]; },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = 1 - i,
                               .end_mode = i});
    }
  });
  chatters(tanks, method, 0.0);
}

TEST_CASE(
    "4.7 a solution that slides along a jump of its derivative ends as chattering, without a "
    "guard",
    "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  // Dry friction, at rest while the force is below 1.
  const Leaf block("block", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           const double v = at.x[1], sign = v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0;
           xdot << v, 1.2 * std::sin(at.time) - sign;
         }});
  });
  const auto results = simulate(block, block.create_context(), {0.0, 1.0},
                                {.rtol = 1e-6, .ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::chattering);
  CHECK(results.statistics.steps < 4000);
  CHECK(contains(results.message, "state x[1] of block 'block' jumps from"));
}
