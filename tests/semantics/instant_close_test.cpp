// Semantics 2.5, 3.1, 5.6: a stop a few roundings of time before or behind the firing of a guard.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

enum class Effect { count, restart, relation };

/// x' = 1 and y' = -y; sin(w x + 1) fires at its zeros, or turns y round. A tick at `tick`.
Leaf wave(double w, Effect effect, double tick = infinite) {
  return Leaf("wave", [=](Leaf& l) {
    const auto sine = [=](const At& at) { return std::sin(w * at.x[0] + 1.0); };
    RelationIndex above;
    if (effect == Effect::relation) above = l.declare_relation({.name = "zero", .guard = sine});
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << 1.0, (effect == Effect::relation && at.relation(above) ? at.x[1] : -at.x[1]);
         }});
    l.declare_discrete_state(vec({0.0}));
    if (effect != Effect::relation) {
      l.declare_zero_crossing({.name = "zero",
                               .guard = sine,
                               .reset_map = effect == Effect::count
                                                ? ResetMap(count_up)
                                                : ResetMap([](const At& at, Next& next) {
                                                    next.set_continuous_state(at.x);
                                                  })});
    }
    if (std::isfinite(tick)) l.declare_one_shot(tick, {}, "tick");
  });
}

SimulatorOptions options(Method method) {
  return {.rtol = 1e-9,
          .atol = 1e-11,
          .ode_solver_method = method,
          .max_minor_step_size = 0.1,
          .throw_errors = false};
}

/// The firing in the middle of a run to 2 s, and how many there are.
std::pair<double, std::size_t> middle(double w, Effect effect, Method method) {
  const Leaf leaf = wave(w, effect);
  const auto times =
      simulate(leaf, leaf.create_context(), {0.0, 2.0}, options(method)).events.times("zero");
  return {times[times.size() / 2], times.size()};
}

constexpr std::array roundings{-4, -1, 0, 1, 2, 4, 10, 30, 60, 100, 1000};

}  // namespace

TEST_CASE("5.6 a run split a few roundings before or behind a firing has it once", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto effect = GENERATE(Effect::count, Effect::restart, Effect::relation);
  for (const double w : {3.0, 7.1, 9.9, 12.3}) {
    const auto [time, count] = middle(w, effect, method);
    for (const int k : roundings) {
      const double split = time + k * eps * time;
      const Leaf leaf = wave(w, effect);
      const auto a = simulate(leaf, leaf.create_context(), {0.0, split}, options(method));
      INFO("method " << method << ", effect " << static_cast<int>(effect) << ", w " << w << ", "
                     << k << " roundings: " << a.message);
      CHECK(a.status == Status::reached_end);
      const auto b = simulate(leaf, a.context, {split, 2.0}, options(method));
      CHECK(b.status == Status::reached_end);
      CHECK(a.events.times("zero").size() + b.events.times("zero").size() == count);
    }
  }
}

TEST_CASE("3.1 a tick a few roundings before or behind a firing disturbs it not", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto effect = GENERATE(Effect::count, Effect::restart, Effect::relation);
  for (const double w : {3.0, 7.1, 9.9, 12.3}) {
    const auto [time, count] = middle(w, effect, method);
    for (const int k : roundings) {
      const double tick = time + k * eps * time;
      const Leaf leaf = wave(w, effect, tick);
      const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0}, options(method));
      INFO("method " << method << ", effect " << static_cast<int>(effect) << ", w " << w << ", "
                     << k << " roundings: " << results.message);
      CHECK(results.status == Status::reached_end);
      CHECK(results.events.times("zero").size() == count);
      const auto ticks = results.events.times("tick", EventKind::time);
      REQUIRE(ticks.size() == 1);
      CHECK_THAT(ticks[0],
                 WithinAbs(tick, 8.0 * eps * tick));  // times that differ by rounding are one
    }
  }
}

TEST_CASE("3.1 a run may be a few roundings long", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double t0 = GENERATE(0.0, 1.0, -3.0, 1e6);
  for (const int k : {1, 2, 10, 1000}) {
    const double end = t0 + k * eps * std::max(std::abs(t0), 1e-3);
    const Leaf leaf = wave(3.0, Effect::count);
    const auto results = simulate(leaf, leaf.create_context(t0), {t0, end}, options(method));
    INFO("method " << method << ", t0 " << t0 << ", " << k << " roundings: " << results.message);
    CHECK(results.status == Status::reached_end);
    CHECK(results.context.time() == end);
  }
}
