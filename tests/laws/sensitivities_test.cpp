// The derivatives of a run: closed forms, the trajectory as it was, nothing where nobody asks.
#include <saltus/models/bouncing_ball.hpp>

#include <cmath>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

const std::vector<std::string> by = {"g", "e", "x[0]"};

Results ball(SimulatorOptions options, double t_end = 12.0) {
  const saltus::Scene scene = models::bouncing_ball();
  return simulate(*scene.system, scene.context, {0.0, t_end}, options);
}

SimulatorOptions tight(Method method) {
  return {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method, .sensitivity = by};
}

}  // namespace

TEST_CASE("the impacts of a ball move as the closed form says", "[sensitivity][ball]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::radau, Method::taylor);
  INFO("method " << to_string(method));
  const Results results = ball(tight(method));
  const Sensitivities& found = results.sensitivities;
  REQUIRE(found.parameters == by);
  REQUIRE(found.event_times.size() == 6 * by.size());
  const double g = 9.81, e = 0.9, y0 = 10.0, first = std::sqrt(2.0 * y0 / g);
  double powers = 1.0, slope = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    // t_k = t_1 (1 + 2 sum of e^j for 0 < j < k); 1e-8: a hundred tolerances, as six flights amplify
    CHECK(std::abs(found.event_times[3 * k] + first * powers / (2.0 * g)) < 1e-8);
    CHECK(std::abs(found.event_times[3 * k + 1] - first * slope) < 1e-8 * 40.0);
    CHECK(std::abs(found.event_times[3 * k + 2] - first * powers / (2.0 * y0)) < 1e-8);
    const double j = static_cast<double>(k) + 1.0;
    powers += 2.0 * std::pow(e, j), slope += 2.0 * j * std::pow(e, j - 1.0);
  }
  CHECK(std::abs(found.continuous_state[1] + 225.42387137755526) < 1e-5);
  CHECK(std::abs(found.continuous_state[4] - 369.7316543555371) < 1e-5);
  CHECK(found.gaps.empty());
}

TEST_CASE("derivatives change no bit of a run", "[sensitivity][ball]") {
  const auto method = GENERATE(Method::automatic, Method::bdf, Method::adams, Method::radau);
  SimulatorOptions options{.ode_solver_method = method};
  const Results alone = ball(options);
  options.sensitivity = by;
  const Results with = ball(options);
  CHECK(alone.context.continuous_state() == with.context.continuous_state());
  CHECK(alone.events.times("bounce") == with.events.times("bounce"));
  CHECK(alone.statistics.steps == with.statistics.steps);
  CHECK(alone.sensitivities.empty());
}

TEST_CASE("a run in pieces has the derivatives of a whole run", "[sensitivity][ball]") {
  const saltus::Scene scene = models::bouncing_ball();
  Simulator simulator(*scene.system, tight(Method::dopri5));
  simulator.initialize(scene.context);
  for (const double t : {1.0, 1.5, 6.0, 12.0}) simulator.advance_to(t);
  const auto& pieces = simulator.results().sensitivities;
  const Results whole = ball(tight(Method::dopri5));
  REQUIRE(pieces.event_times.size() == whole.sensitivities.event_times.size());
  for (std::size_t i = 0; i < pieces.event_times.size(); ++i)
    CHECK(std::abs(pieces.event_times[i] - whole.sensitivities.event_times[i]) < 1e-8 * 40.0);
}

TEST_CASE("a name without a derivative is refused before the run", "[sensitivity][errors]") {
  for (const char* name : {"h", "mode", "x[2]"}) {
    INFO(name);
    CHECK_THROWS_AS(ball({.sensitivity = {name}}), ModelError);
  }
  CHECK_THROWS_AS(ball({.sensitivity = {"e", "e"}}), ModelError);
}

TEST_CASE("a jump of the flow without an event has a gap; a kink, and a jump in time, have none",
          "[sensitivity]") {
  const auto gaps = [](auto rate) {
    const Leaf leaf("leaf", [&](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({0.3}), .ode = [rate](const At& at) { return rate(at.time, at.x[0]); }});
    });
    const Results results =
        simulate(leaf, leaf.create_context(), {0.0, 2.0},
                 {.ode_solver_method = Method::dopri5, .sensitivity = {"x[0]"}});
    CHECK(std::isnan(results.sensitivities.continuous_state[0]) ==
          !results.sensitivities.gaps.empty());
    return results.sensitivities.gaps.size();
  };
  CHECK(gaps([](double, double x) { return x < 1.0 ? 2.0 : 1.0; }) == 1);
  CHECK(gaps([](double, double x) { return std::max(x, 1.0); }) == 0);
  CHECK(gaps([](double t, double x) { return (t < 1.0 ? 2.0 : 1.0) - x; }) == 0);
  CHECK(gaps([](double, double x) { return -x * x * x; }) == 0);
}

TEST_CASE("a state that rests at a kink of a formula has a gap, and one that goes through has none",
          "[sensitivity]") {
  const auto gaps = [](double start, const auto& rate) {
    const Leaf leaf("leaf", [&](Leaf& l) {
      const ParameterIndex p = l.declare_dynamic_parameter("p", 0.0);
      l.declare_continuous_state({.initial = vec({start}), .formula = Formula([=](const auto& at) {
                                                             return rate(at.x(0), at.p(p, 0));
                                                           })});
    });
    const Results results =
        simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.sensitivity = {"x[0]", "p"}});
    std::vector<std::string> lost;
    for (const SensitivityGap& gap : results.sensitivities.gaps) lost.push_back(gap.parameter);
    for (std::size_t k = 0; k < 2; ++k) {
      const bool gone = std::isnan(results.sensitivities.continuous_state[k]);
      CHECK(gone == (std::ranges::count(lost, k == 0 ? "x[0]" : "p") == 1));
    }
    return lost;
  };
  using Names = std::vector<std::string>;
  using std::abs;
  CHECK(gaps(0.0, [](const auto& x, const auto& p) { return p - abs(x); }) == Names{"x[0]", "p"});
  CHECK(gaps(0.0, [](const auto& x, const auto&) { return -abs(x) * x; }) == Names{});
  CHECK(gaps(1.0, [](const auto& x, const auto&) { return -abs(x); }) == Names{});
  CHECK(gaps(-0.5, [](const auto& x, const auto&) { return 1.0 + abs(x); }) == Names{});
  CHECK(gaps(0.0, [](const auto& x, const auto&) { return 1.0 + abs(x); }) == Names{});
  CHECK(gaps(1.0, [](const auto& x, const auto& p) { return abs(p) - x; }) == Names{"p"});
}

TEST_CASE("a ball that is thrown down from its floor has a gap: a little lower it falls",
          "[sensitivity][ball]") {
  const saltus::Scene scene = models::bouncing_ball();
  const Results results = simulate(*scene.system, scene.context.with_continuous_state({0.0, -3.0}),
                                   {0.0, 0.2}, {.sensitivity = {"x[0]"}});
  REQUIRE(results.sensitivities.gaps.size() == 1);
  CHECK(results.sensitivities.gaps[0].reason == "the guard was at zero already");
}

TEST_CASE("at an event that moves, each entry that the event changes has a gap, and no other",
          "[sensitivity]") {
  // x0 is a clock, x1 the time of the event; the reset map sets x2, and starts x3.
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.5, 0.0, 0.0}),
         .ode = [](const At& at, VectorRef f) { f << 1.0, 0.0, 0.0, at.z[0]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "on",
                             .guard = [](const At& at) { return at.time - at.x[1]; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state(vec({at.x[0], at.x[1], 1.0, at.x[3]}));
                                   next.set_discrete_state(vec({1.0}));
                                 },
                             .direction = Direction::negative_then_non_negative});
  });
  const auto at_end = [&](double t) {
    return simulate(leaf, leaf.create_context(), {0.0, t}, {.sensitivity = {"x[1]"}}).sensitivities;
  };
  const Sensitivities there = at_end(0.5), later = at_end(0.75);
  const std::vector<bool> changes = {false, false, true, true};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    INFO("state " << i);
    CHECK(std::isnan(there.continuous_state[i]) == changes[i]);
    CHECK(!std::isnan(later.continuous_state[i]));
  }
  CHECK(std::isnan(there.discrete_state[0]));
  REQUIRE(there.gaps.size() == 1);
  CHECK(there.gaps[0].event == "leaf.on");
  CHECK(later.gaps.empty());
}
