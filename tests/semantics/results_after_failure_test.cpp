// Semantics 5.6a: the context of a run that failed is the last accepted state, and the run goes on
// from it.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

enum class Where { nowhere, ode, guard, reset, update, output };
constexpr std::array functions{Where::ode, Where::guard, Where::reset, Where::update,
                               Where::output};

/// x' = -x from 1, back to 1 at 1/2 (t = 0.69, 1.39), a tick each 0.25 s. After `since` [s] one of
/// its functions throws or gives NaN.
struct Fragile {
  Where where = Where::nowhere;
  double since = 0.0;
  bool throws = true;

  double trouble(Where here, double t) const {
    if (here != where || !(t > since)) return 0.0;
    return throws ? throw std::domain_error("mine") : not_a_number;
  }
  double rate(const At& at) const { return -at.x[0] + trouble(Where::ode, at.time); }
  double above(const At& at) const { return at.x[0] - 0.5 + trouble(Where::guard, at.time); }
  double shown(const At& at) const { return at.x[0] + trouble(Where::output, at.time); }

  Leaf leaf() const {
    return {
        "fragile", [this](Leaf& l) {
          l.declare_continuous_state(
              {.initial = vec({1.0}), .ode = [this](const At& at) { return rate(at); }});
          l.declare_discrete_state(vec({0.0}));
          l.declare_output_port({.name = "y", .calc = [this](const At& at) { return shown(at); }});
          l.declare_discrete_state_output("z");
          l.declare_zero_crossing({.name = "half",
                                   .guard = [this](const At& at) { return above(at); },
                                   .reset_map =
                                       [this](const At& at, Next& next) {
                                         next.set_continuous_state(
                                             {1.0 + trouble(Where::reset, at.time)});
                                       }});
          l.declare_periodic_update(
              [this](const At& at, Next& next) {
                next.set_discrete_state({at.z[0] + 1.0 + trouble(Where::update, at.time)});
              },
              0.25, 0.0, "tick");
        }};
  }
};

SimulatorOptions recorded(const Leaf& leaf, Method method) {
  return {.ode_solver_method = method,
          .recorded_signals = {{"y", leaf.output("y")}, {"z", leaf.output("z")}},
          .throw_errors = false};
}

/// Whether a context is row i, to the bit.
bool is_row(const Context& context, const Results& results, std::size_t i) {
  return results.time[i] == context.time() &&
         column(results, "y")[i] == context.continuous_state()[0] &&
         column(results, "z")[i] == context.discrete_state()[0];
}
bool is_some_row(const Context& context, const Results& results) {
  for (std::size_t i = 0; i < results.time.size(); ++i)
    if (is_row(context, results, i)) return true;
  return false;
}

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& rest) {
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

}  // namespace

TEST_CASE("5.6a a function that throws leaves a state of the unbroken run, to the bit",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Where where = GENERATE(from_range(functions));
  const double since = GENERATE(0.0, 0.6, 0.7, 1.3);  // first step, later, after an event, later
  INFO("method " << method << ", function " << static_cast<int>(where) << ", since " << since);
  Fragile fragile{where, since};
  const Leaf leaf = fragile.leaf();
  const auto options = recorded(leaf, method);
  const Results failed = simulate(leaf, leaf.create_context(), {0.0, 2.0}, options);
  REQUIRE(failed.status == Status::failed);

  fragile.where = Where::nowhere;
  const Results whole = simulate(leaf, leaf.create_context(), {0.0, 2.0}, options);
  CHECK(is_some_row(failed.context, whole));
  CHECK(failed.time.back() <= failed.context.time());
  if (where != Where::output) CHECK(is_row(failed.context, failed, failed.time.size() - 1));
}

TEST_CASE("5.6a a value that is not finite leaves the last row", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Where where = GENERATE(Where::ode, Where::guard, Where::reset, Where::update);
  const double since = GENERATE(0.0, 0.6, 0.7, 1.3);
  INFO("method " << method << ", function " << static_cast<int>(where) << ", since " << since);
  const Fragile fragile{where, since, false};
  const Leaf leaf = fragile.leaf();
  const Results failed = simulate(leaf, leaf.create_context(), {0.0, 2.0}, recorded(leaf, method));
  REQUIRE(failed.status == Status::failed);
  CHECK(is_row(failed.context, failed, failed.time.size() - 1));
}

TEST_CASE("5.6a a run that failed goes on from its context as the unbroken run", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Where where = GENERATE(from_range(functions));
  const double since = GENERATE(0.0, 0.6, 0.7, 1.3);
  const bool throws = GENERATE(true, false);
  INFO("method " << method << ", function " << static_cast<int>(where) << ", since " << since
                 << ", throws " << throws);
  Fragile fragile{where, since, throws};
  const Leaf leaf = fragile.leaf();
  const auto options = recorded(leaf, method);
  Simulator simulator(leaf, options);
  simulator.initialize(leaf.create_context());
  CHECK(simulator.advance_to(2.0) == Status::failed);
  const Results failed = simulator.results();

  fragile.where = Where::nowhere;
  const Results whole = simulate(leaf, leaf.create_context(), {0.0, 2.0}, options);
  simulator.initialize(failed.context);
  CHECK(simulator.advance_to(2.0) == Status::reached_end);
  CHECK(joined(events(failed.events), events(simulator.results().events)) == events(whole.events));
  const Context end = simulator.context();
  CHECK(end.discrete_state() == whole.context.discrete_state());
  // Two runs within the tolerances 1e-6 |x| + 1e-8, with |x| <= 1; ten tolerances each (2.9).
  CHECK(std::abs(end.continuous_state()[0] - whole.context.continuous_state()[0]) < 2e-5);
}

TEST_CASE("5.6a an instant that fails in its second pass is undone as a whole", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  bool broken = true;
  // The first reset carries the second guard across zero; its reset fails.
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, -1.0}), .ode = [](const At&, VectorRef xdot) { xdot << 1.0, 0.0; }});
    l.declare_continuous_state_output("x");
    l.declare_zero_crossing(
        {.name = "first",
         .guard = [](const At& at) { return at.x[0] - 0.5; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0, 1.0}); }});
    l.declare_zero_crossing({.name = "second",
                             .guard = [](const At& at) { return at.x[1]; },
                             .reset_map =
                                 [&](const At& at, Next& next) {
                                   if (broken) throw std::domain_error("mine");
                                   next.set_continuous_state({at.x[0], -1.0});
                                 }});
  });
  const SimulatorOptions options{.ode_solver_method = method,
                                 .recorded_signals = {{"x", leaf.output("x")}},
                                 .throw_errors = false};
  const Results failed = simulate(leaf, leaf.create_context(), {0.0, 0.75}, options);
  REQUIRE(failed.status == Status::failed);
  CHECK(failed.context.continuous_state()[1] == -1.0);
  CHECK(failed.time.back() == failed.context.time());
  CHECK(failed.events.empty());
  broken = false;
  const Results rest = simulate(leaf, failed.context, {failed.context.time(), 0.75}, options);
  const Results whole = simulate(leaf, leaf.create_context(), {0.0, 0.75}, options);
  CHECK(events(rest.events) == events(whole.events));
  CHECK(events(whole.events).size() == 2);
}

TEST_CASE("5.6a a hold, a count and a mode go on after a failure", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double since = GENERATE(0.5, 3.0);  // while it bounces, and at rest
  INFO("method " << method << ", since " << since);
  bool broken = true;
  const Leaf ball("ball", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [&](const At& at, VectorRef xdot) {
           if (broken && at.time > since) throw std::domain_error("mine");
           xdot << at.x[1], -9.81;
         }});
    l.declare_one_shot(3.5, {}, "look");
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    l.declare_output_port({.name = "y", .calc = [&](const At& at) {
                             if (broken && at.time > since) throw std::domain_error("mine");
                             return at.x[0];
                           }});
  });
  const SimulatorOptions options{.ode_solver_method = method,
                                 .recorded_signals = {{"y", ball.output("y")}},
                                 .throw_errors = false};
  const Results failed = simulate(ball, ball.create_context(), {0.0, 4.0}, options);
  REQUIRE(failed.status == Status::failed);
  broken = false;
  const Results whole = simulate(ball, ball.create_context(), {0.0, 4.0}, options);
  const Results rest = simulate(ball, failed.context, {failed.context.time(), 4.0}, options);
  CHECK(count(failed.events, EventKind::zeno_enter) + count(rest.events, EventKind::zeno_enter) ==
        count(whole.events, EventKind::zeno_enter));
  CHECK(count(rest.events, EventKind::zeno_release) == 0);
  CHECK(rest.context.continuous_state().norm() < 1e-6);  // at rest on the floor
}

TEST_CASE("5.6a after a failure advance_to asks for initialize", "[semantics]") {
  Fragile fragile{Where::ode, 0.5};
  const Leaf leaf = fragile.leaf();
  Simulator simulator(leaf, recorded(leaf, Method::dopri5));
  CHECK(contains(message<ModelError>([&] { simulator.advance_to(1.0); }), "call initialize"));
  simulator.initialize(leaf.create_context());
  simulator.advance_to(2.0);
  const Context kept = simulator.context();
  CHECK(contains(message<ModelError>([&] { simulator.advance_to(2.0); }),
                 "initialize(results.context)"));
  CHECK(same_bits(simulator.context(), kept));
}
