// What an author may say of a guard: at_start, on_zeno, max_count, the states that a hold keeps.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;

/// x' = 1 from `start`; guard x, upward, counted.
std::shared_ptr<Leaf> upward(double start, AtStart choice) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, 1.0, start);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "up",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = Direction::negative_then_non_negative,
                             .at_start = choice});
  });
}

/// A ball that also moves sideways with 1 m/s: y, v, x.
std::shared_ptr<Leaf> thrown_ball(OnZeno choice, std::vector<std::vector<int>> holds, double e) {
  return make_leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           const bool rolls = at.mode == 1;
           xdot << (rolls ? 0.0 : at.x[1]), (rolls ? 0.0 : -g), (rolls ? 2.0 : 1.0);
         }});
    l.declare_default_mode(0);
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1], at.x[2]}); },
         .direction = Direction::positive_then_non_positive,
         .on_zeno = choice,
         .holds = holds});
  });
}

constexpr double relative = 1e-10, absolute = 1e-12;  // tolerances

Results run(const Form& form, Method method, double end) {
  return simulate(
      *form.system, form.context(), {0.0, end},
      {.rtol = relative, .atol = absolute, .ode_solver_method = method, .throw_errors = false});
}

/// Rest of a dropped ball is seen this early or late: exact but for a multistep method, which is
/// blind to flights lower than the errors of a flight.
double rest_error(Method method, double e) {
  const double blind = one_step(method) ? 0.0 : 40.0 * (relative + absolute);
  return 1e-9 + 8.0 * std::sqrt(2.0 * blind / g) / (1.0 - e);
}

}  // namespace

// now.
TEST_CASE("at zero at the start, heading across: a guard does what its author says",
          "[laws][choices]") {
  const auto method = GENERATE(from_range(methods));
  for (const double start : {0.0, 0.5}) {
    for (const auto& [choice, fires] :
         {std::pair{AtStart::automatic, start == 0.0}, std::pair{AtStart::ignore, false},
          std::pair{AtStart::fire, true}}) {
      for (const Form& form : forms(upward(start, choice))) {
        INFO(form.name << ", method " << method << ", start " << start);
        const auto results = run(form, method, 1.0);
        CHECK(results.status == Status::reached_end);
        CHECK(results.context.discrete_state()[0] == (fires ? 1.0 : 0.0));
        if (fires && !results.events.empty()) CHECK(results.events[0].time == 0.0);
      }
    }
    const auto leaf = upward(start, AtStart::error);
    const std::string what = message<SimulationError>([&] {
      simulate(*leaf, leaf->create_context(), {0.0, 1.0}, {.ode_solver_method = method});
    });
    CHECK(contains(what, "leaf.up"));
  }
}

TEST_CASE("at its Zeno point a ball stops the run, is an error, or goes on in a mode",
          "[laws][choices][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.5);
  const double rest = BallExact{g, e, 1.0}.rest(), error = rest_error(method, e);
  for (const Form& form : forms(thrown_ball(OnZeno::stop(), {}, e))) {
    const auto results = run(form, method, 5.0);
    CHECK(results.status == Status::zeno_stop);
    within(text("Zeno stop ", form.name), method, std::abs(results.context.time() - rest),
           1e-6 + error);
  }
  for (const Form& form : forms(thrown_ball(OnZeno::error(), {}, e))) {
    const auto results = run(form, method, 5.0);
    CHECK(results.status == Status::failed);
    CHECK(contains(results.message, "bounce"));
  }
  for (const Form& form : forms(thrown_ball(OnZeno::enter(1), {}, e))) {
    const auto results = run(form, method, 5.0);
    CHECK(results.status == Status::reached_end);
    const auto& x = results.context.continuous_state();
    within(text("Zeno mode ", form.name), method,
           std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2] - (rest + 2.0 * (5.0 - rest)))}),
           2e-6 + 3.0 * error);
  }
}

TEST_CASE("a hold keeps the states it is said to, the others go on", "[laws][choices][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.5);
  for (const Form& form : forms(thrown_ball(OnZeno::hold(), {{0, 1}}, e))) {
    const auto results = run(form, method, 5.0);
    CHECK(results.status == Status::reached_end);
    CHECK(count(results.events, EventKind::zeno_enter) == 1);
    const auto& x = results.context.continuous_state();
    within(text("hold in part, at rest ", form.name), method,
           std::max(std::abs(x[0]), std::abs(x[1])), 1e-9 + g * rest_error(method, e));
    within(text("hold in part, goes on ", form.name), method, std::abs(x[2] - 5.0),
           allowed(method, relative, absolute, 5.0));
  }
}

TEST_CASE("a terminal guard with max_count n ends the run on its n-th firing", "[laws][choices]") {
  const auto method = GENERATE(from_range(methods));
  const int n = GENERATE(1, 2, 7);
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .terminal = true,
         .max_count = n});
  });
  for (const Form& form : forms(leaf)) {
    const auto results = run(form, method, 100.0);
    CHECK(results.status == Status::terminal);
    within(text("max_count ", form.name), method, std::abs(results.context.time() - n),
           n * 400.0 * eps * n);
  }
}
