// Semantics 4.1 and 4.4: which guards have a Zeno monitor, and which states rest.
#include <numbers>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two tanks that one hose fills in turn (Johansson et al. 1999): Zeno time 24 s, both at 5.
Leaf tanks(bool by_reset) {
  return Leaf("tanks", [=](Leaf& l) {
    l.declare_default_mode(1);
    l.declare_continuous_state(
        {.initial = vec({8.0, 8.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << (at.mode == 1 ? 0.25 : -0.5), (at.mode == 1 ? -0.5 : 0.25);
         }});
    for (const int mode : {1, 2}) {
      ZeroCrossing low{.name = text("low", mode),
                       .guard = [=](const At& at) { return at.x[mode == 1 ? 1 : 0] - 5.0; },
                       .direction = Direction::positive_then_non_positive,
                       .start_mode = mode};
      if (by_reset)
        low.reset_map = [=](const At&, Next& next) { next.set_mode(3 - mode); };
      else
        low.end_mode = 3 - mode;
      l.declare_zero_crossing(std::move(low));
    }
  });
}

}  // namespace

TEST_CASE("4.1 a mode that a reset map writes is an effect, as one by end_mode is", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf = tanks(GENERATE(false, true));
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 30.0}, {.ode_solver_method = method});
  INFO(method);
  REQUIRE(count(results.events, EventKind::zeno_enter) >= 1);
  CHECK(results.context.time() == 30.0);
  // The last gaps are within zeno_tolerance, 1e-6 s: the prediction is at least as good as a gap.
  for (const double level : results.context.continuous_state()) CHECK(std::abs(level - 5.0) < 1e-6);
}

TEST_CASE("4.1 discrete state is an effect: the twisting algorithm comes to rest", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  // x'' = -3 sign(x) - sign(x'): the signs are discrete states. Zeno time 5.12132034 s.
  const Leaf leaf("twist", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -3.0 * at.z[0] - at.z[1]; }});
    l.declare_discrete_state(vec({1.0, -1.0}));
    for (const Index i : {0, 1}) {
      l.declare_zero_crossing({.name = text("sign", i),
                               .guard = [=](const At& at) { return at.x[i]; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     Eigen::VectorXd z = at.z;
                                     z[i] = -z[i];
                                     next.set_discrete_state(z);
                                   }});
    }
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 10.0},
                                {.rtol = 1e-10, .atol = 1e-13, .ode_solver_method = method});
  INFO(method);
  CHECK(count(results.events, EventKind::zeno_enter) >= 1);
  // One gap of 1e-6 s at an acceleration of 4 leaves a speed of 4e-6.
  CHECK(std::abs(results.context.continuous_state()[0]) < 1e-9);
  CHECK(std::abs(results.context.continuous_state()[1]) < 1e-5);
}

namespace {

/// A ball (entries 0, 1) beside a state that has nothing to do with it, x' = 0.37.
Leaf ball_beside(std::optional<Touches> touches, bool counts = false) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -10.0, 0.37; },
         .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   next.set_continuous_state({0.0, -0.5 * at.x[1], at.x[2]});
                                   if (counts) next.set_discrete_state({at.z[0] + 1.0});
                                 },
                             .direction = Direction::positive_then_non_positive,
                             .touches = touches});
  });
}

const Event& hold_of(const Results& results, std::vector<Event>& kept) {
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind == EventKind::zeno_enter) kept.push_back(results.events[i]);
  }
  REQUIRE(kept.size() == 1);
  return kept.front();
}

}  // namespace

TEST_CASE("4.4 a hold stops what its guard reads and its effect writes, and nothing else",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(false, true);  // a counter that no derivative reads steers nothing
  const Leaf leaf = ball_beside(Touches{{{0}}, {0, 1}, counts, false}, counts);
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 9.5}, {.ode_solver_method = method});
  std::vector<Event> kept;
  CHECK(std::ranges::equal(hold_of(results, kept).rests, std::vector{0, 1}));
  CHECK(std::abs(results.context.continuous_state()[2] - 0.37 * 9.5) < 1e-6);
  CHECK(std::abs(results.context.continuous_state()[0]) < 1e-9);
}

TEST_CASE("4.4 where nothing tells what a guard touches, the leaf rests, and the log says so",
          "[semantics]") {
  const Leaf leaf = ball_beside({});
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 9.5}, {});
  std::vector<Event> kept;
  const Event& hold = hold_of(results, kept);
  CHECK(std::ranges::equal(hold.rests, std::vector{0, 1, 2}));
  CHECK(std::abs(results.context.continuous_state()[2] - 0.37 * hold.time) < 1e-6);
}

TEST_CASE("4.4 a run that was cut while part of a leaf rested goes on in the same way",
          "[semantics]") {
  const Leaf leaf = ball_beside(Touches{{{0}}, {0, 1}, false, false});
  const auto first = simulate(leaf, leaf.create_context(), {0.0, 5.0}, {});
  const auto second = simulate(leaf, first.context, {5.0, 9.5}, {});
  CHECK(std::abs(second.context.continuous_state()[2] - 0.37 * 9.5) < 1e-6);
  CHECK(second.context.continuous_state()[0] == first.context.continuous_state()[0]);
}

TEST_CASE("4.2 a firing whose reset map writes nothing is no part of a series", "[semantics]") {
  // x' = 1; the guard crosses zero downwards at 10 log(1 - x_k) = -(2 k + 1/2) pi, so its gaps shrink
  // by q = exp(-2 pi / 10). The reset map counts the crossings in n, from number `silent` on.
  const auto method = GENERATE(from_range(methods));
  const int silent = GENERATE(0, 1, 3, 4, 5, 9);
  INFO(method << ", " << silent << " firings write nothing");
  const double step = 2.0 * std::numbers::pi / 10.0, q = std::exp(-step);
  const double bound = 1.0 - std::exp(-step * (silent - 0.25));
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [](const At&, VectorRef xdot) { xdot << 1.0, 0.0; }});
    l.declare_zero_crossing(
        {.name = "series",
         .guard = [](const At& at) { return std::cos(10.0 * std::log(1.0 - at.x[0])); },
         .reset_map =
             [=](const At& at, Next& next) {
               if (at.x[0] > bound) next.set_continuous_state({at.x[0], at.x[1] + 1.0});
             },
         .direction = Direction::positive_then_non_positive,
         .on_zeno = OnZeno::stop(),
         .zeno_tolerance = 0.5});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 1.0 - 1e-4},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  REQUIRE(count(results.events, EventKind::zeno_enter) == 1);
  // The fourth of the series accumulates: n = 4, and q / (1 - q) for the firings to come. The times
  // are right to rtol times the slope of the guard, 10 / (1 - x) < 2e4.
  CHECK(std::abs(results.context.time() - (1.0 - std::exp(-step * (silent + 3.25)))) < 1e-6);
  CHECK(std::abs(results.context.continuous_state()[1] - (4.0 + q / (1.0 - q))) < 1e-5);
}
