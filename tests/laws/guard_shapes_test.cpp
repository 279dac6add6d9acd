// Guards of awkward shape: a kink, a jump, a plateau, one of two hundred, one within the first
// step.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

template <class Guard>
std::shared_ptr<Leaf> counted(Guard guard, Direction direction = Direction::crosses_zero) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "hit", .guard = guard, .reset_map = count_up, .direction = direction});
  });
}

void fires_at(const std::string& scene, const std::shared_ptr<Leaf>& leaf, Method method,
              double end, const std::vector<double>& expected, double max_step = infinite) {
  for (const Form& form : forms(leaf)) {
    const auto results = simulate(*form.system, form.context(), {0.0, end},
                                  {.ode_solver_method = method, .max_minor_step_size = max_step});
    // x = t has no error of integration: 100 eps (|t| + |h|) of a location, each step again.
    within(text(scene, " ", form.name), method, worst(firing_times(results.events), expected),
           200.0 * eps * end);
    CHECK(results.context.discrete_state()[0] == static_cast<double>(expected.size()));
  }
}

}  // namespace

TEST_CASE("a guard with a kink, at its root or between two, fires at its roots", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  fires_at("kink between roots",
           counted([](const At& at) { return std::abs(at.x[0] - 1.0) - 0.4; }), method, 2.0,
           {0.6, 1.4}, 0.5);
  const auto bent = [](const At& at) {
    const double s = at.x[0] - 0.7;
    return s < 0.0 ? 1e-6 * s : 1e6 * s;
  };
  fires_at("kink at the root", counted(bent), method, 1.0, {0.7});
}

TEST_CASE("a guard that jumps across zero fires at its jump", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double size = GENERATE(1.0, 1e-200, 1e200);
  const auto jump = [=](const At& at) { return at.x[0] < 0.3 ? -size : 3.0 * size; };
  fires_at("jump", counted(jump), method, 1.0, {0.3});
}

TEST_CASE("a guard that reaches a plateau of zeros fires when it reaches it, once",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  // Up to the plateau at 1, on it until 2. Reaching it counts; going on up or down does not.
  for (const double after : {1.0, -1.0}) {
    const auto plateau = [=](const At& at) {
      return std::min(at.x[0] - 1.0, 0.0) + after * std::max(at.x[0] - 2.0, 0.0);
    };
    fires_at(text("plateau, then ", after), counted(plateau, Direction::negative_then_non_negative),
             method, 3.0, {1.0}, 0.1);
  }
}

// Dormant from the start: zero until 1, and no side yet. Leaving it is no crossing from either.
TEST_CASE("a guard that is zero from the start fires neither on the plateau nor on leaving it",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double after = GENERATE(1.0, -1.0);
  const auto late = [=](const At& at) { return after * std::max(at.x[0] - 1.0, 0.0); };
  fires_at(text("zero from the start, then ", after), counted(late), method, 2.0, {}, 0.1);
}

TEST_CASE("of two hundred guards the one that crosses fires", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (int i = 0; i < 200; ++i) {
      const double root = i == 137 ? 0.537 : 2.0 + i;
      l.declare_zero_crossing({.name = text("guard_", i),
                               .guard = [=](const At& at) { return at.x[0] - root; },
                               .reset_map = count_up});
    }
  });
  fires_at("one of 200", leaf, method, 1.0, {0.537});
}

TEST_CASE("an event within the first step is found, however early", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double at = GENERATE(1e-3, 1e-9, 1e-14, 1e-100, 1e-300);
  for (const Form& form : forms(counted([=](const At& now) { return now.x[0] - at; }))) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0}, {.ode_solver_method = method});
    // 100 eps (|t| + |h|), and the step may be all of the run.
    within(text("first step, at ", at, " ", form.name), method,
           worst(firing_times(results.events), {at}), 100.0 * eps * (at + 1.0));
  }
}
