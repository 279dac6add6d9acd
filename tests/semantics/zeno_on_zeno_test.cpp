// Semantics 4.4: what a Zeno point means to a guard: hold, stop, error, or a mode to go on in.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 10.0, rest = 0.6;  // from 0.2 m, restitution 1/2: t1 (1 + e) / (1 - e)
enum { flying, sliding };

/// A ball over a floor at 0 with a path s: it slides at 1 m/s in the mode `sliding`.
Leaf ball(OnZeno on_zeno, double e = 0.5) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.2, 0.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           if (at.mode == sliding)
             xdot << 0.0, 0.0, 1.0;
           else
             xdot << at.x[1], -g, 0.0;
         }});
    l.declare_default_mode(flying);
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1], at.x[2]}); },
         .direction = Direction::positive_then_non_positive,
         .start_mode = flying,
         .on_zeno = on_zeno});
  });
}

Results run(const Leaf& leaf, Method method, bool throw_errors = true) {
  return simulate(
      leaf, leaf.create_context(), {0.0, 2.0},
      {.rtol = 1e-10, .atol = 1e-13, .ode_solver_method = method, .throw_errors = throw_errors});
}

}  // namespace

TEST_CASE("4.4 on_zeno hold is the default", "[semantics]") {
  CHECK(ZeroCrossing{}.on_zeno.kind() == OnZeno::Kind::hold);
  CHECK(EdgeReset{}.on_zeno.kind() == OnZeno::Kind::hold);
}

TEST_CASE("4.4 on_zeno stop ends the run well, with the status zeno_stop", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.5, 0.0);
  INFO("method " << method << ", e " << e);
  const auto results = run(ball(OnZeno::stop(), e), method);
  CHECK(results.status == Status::zeno_stop);
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  // Not later than the accumulation time, and not earlier than a tolerance of 1e-6 s before it.
  CHECK_THAT(results.context.time(), WithinAbs(e > 0.0 ? rest : 0.2, 1e-5));
  CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.0, 1e-5));
}

TEST_CASE("4.4 on_zeno error is an error with block, guard, time and remedy", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto what = message<SimulationError>([&] { run(ball(OnZeno::error()), method); });
  INFO("method " << method << ": " << what);
  CHECK(contains(what, "ball"));
  CHECK(contains(what, "bounce"));
  CHECK(contains(what, "on_zeno"));
  const auto results = run(ball(OnZeno::error()), method, false);
  CHECK(results.status == Status::failed);
  CHECK(results.events.times("bounce").size() > 5);
}

TEST_CASE("4.4 on_zeno with a mode goes on there from the accumulation state", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.5, 0.0);
  INFO("method " << method << ", e " << e);
  const auto results = run(ball(OnZeno::enter(sliding), e), method);
  CHECK(results.status == Status::reached_end);
  CHECK(results.context.mode() == sliding);
  const auto& x = results.context.continuous_state();
  // The height and speed at rest, and the path since: known to 1e-5 s with adams and bdf.
  CHECK_THAT(x[0], WithinAbs(0.0, 1e-9));
  CHECK_THAT(x[1], WithinAbs(0.0, 1e-5));
  CHECK_THAT(x[2], WithinAbs(2.0 - (e > 0.0 ? rest : 0.2), 1e-5));
}
