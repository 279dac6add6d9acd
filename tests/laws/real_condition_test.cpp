// A real number as the condition of a choice: true while it is not zero. A number that moves through
// zero is there for no time, so the choice does not change; a number that rests at zero is false meanwhile.
#include <algorithm>
#include <functional>
#include <numbers>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace real_condition {

using std::numbers::pi;

/// A number as a condition, by the blocks that compute it; `add` returns the last of them.
struct Condition {
  std::string name;
  std::function<const System*(DiagramBuilder&)> add;
  bool called = false;  ///< by a function, of which `taylor` has no series
};

struct Found {
  double integral = 0.0;    ///< of the choice between 1 and -1
  bool some_false = false;  ///< whether a row behind the start shows the false branch
};

const System* behind(DiagramBuilder& builder, const System& source, const System& block) {
  builder.connect(source.output(), block.input(0));
  return &block;
}

/// sin(t + phase).
const System& sine(DiagramBuilder& builder, double phase = 0.3) {
  return builder.add<Sine>("sine", SineOptions{.phase = phase});
}

/// f(sin(t + 0.3)) by a called function.
template <class F>
Condition called(const std::string& name, F f) {
  return {name,
          [=](DiagramBuilder& b) { return behind(b, sine(b), b.add<FunctionBlock>("called", f)); },
          true};
}

/// The sine behind a DeadZone, which is zero for half of the time.
Condition dead_zone(const std::string& name, bool shifted, double phase) {
  return {name, [=](DiagramBuilder& b) {
            const DeadZoneOptions options{.half_range = std::sin(pi / 4.0), .shifted = shifted};
            return behind(b, sine(b, phase), b.add<DeadZone>("dead", options));
          }};
}

void integrate(DiagramBuilder& builder, const System& from, const std::string& name) {
  auto& x = builder.add<Integrator>(name, Integrator::Options{});
  builder.connect(from.output(), x.input());
}

/// The choice by `IfThenElse`, or by a `Switch` without a threshold, integrated from 0 to `end`. Beside
/// it a comparison has its root at each zero of the condition, and a pulse changes each half second.
Found run(const Condition& condition, bool with_switch, double end, Method method) {
  DiagramBuilder builder;
  const auto choice = [&]() -> const System& {
    if (with_switch) return builder.add<Switch>("choice");
    return builder.add<IfThenElse>("choice");
  };
  const System& chosen = choice();
  integrate(builder, chosen, "x");
  const System& number = *condition.add(builder);
  const System& yes = builder.add<Constant>("yes", 1.0);
  const System& no = builder.add<Constant>("no", -1.0);
  const System& zero = builder.add<Constant>("zero", 0.0);
  const System& beside = builder.add<Comparator>("beside", ">");
  builder.connect(number.output(), chosen.input(with_switch ? "control" : "condition"));
  builder.connect(yes.output(), chosen.input("true_value"));
  builder.connect(no.output(), chosen.input("false_value"));
  builder.connect(number.output(), beside.input(0));
  builder.connect(zero.output(), beside.input(1));
  integrate(builder, beside, "w");
  integrate(builder, builder.add<Pulse>("pulse", Pulse::Options{.period = 1.0}), "y");
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, end},
               {.ode_solver_method = method, .recorded_signals = {{"choice", chosen.output()}}});
  const auto rows = results.output("choice");
  double least = 1.0;
  for (std::size_t i = 0; i < results.time.size(); ++i)
    if (results.jump[i] > 0 || results.time[i] > 0.0)
      least = std::min(least, rows(static_cast<Index>(i), 0));
  return {results.context.continuous_state()[0], least < 0.0};
}

}  // namespace real_condition

using namespace real_condition;

TEST_CASE("a number that moves through zero is a true condition", "[laws][relations]") {
  const auto clock = [](double zero) {
    return [=](DiagramBuilder& b) {
      return behind(b, b.add<Clock>("clock"), b.add<Offset>("offset", -zero));
    };
  };
  const std::vector<Condition> conditions = {
      {"sine", [](DiagramBuilder& b) { return &sine(b); }},
      {"sine from zero", [](DiagramBuilder& b) { return &sine(b, 0.0); }},
      {"clock, at a tick", clock(1.5)},
      {"clock, between ticks", clock(1.3)},
      {"clock from zero", clock(0.0)},
      {"state, at a tick",
       [](DiagramBuilder& b) {
         return behind(b, b.add<Constant>("one", 1.0),
                       b.add<Integrator>("ramp", Integrator::Options{.initial_state = -1.5}));
       }},
      called("cube", [](double u) { return u * u * u; }),
      called("square", [](double u) { return u * u; }),
      called("number", [](double u) { return u; }),
  };
  const auto method = GENERATE(Method::taylor, from_range(methods));
  const bool with_switch = GENERATE(false, true);
  for (const Condition& condition : conditions) {
    if (condition.called && method == Method::taylor) continue;
    INFO(condition.name << ", method " << method << ", switch " << with_switch);
    const Found found = run(condition, with_switch, 4.0 * pi, method);
    // A rate of 1 is integrated exactly, up to the rounding of each step. A number that begins at zero
    // is false in the first row, before the flow has a say.
    CHECK(std::abs(found.integral - 4.0 * pi) < 1e-12);
    CHECK(!found.some_false);
  }
}

TEST_CASE("a number that rests at zero is a false condition meanwhile", "[laws][relations]") {
  const double edge = std::sin(pi / 4.0);
  const std::vector<std::pair<Condition, double>> conditions = {
      {dead_zone("dead zone", false, 0.3), 0.5},
      {dead_zone("shifted dead zone", true, 0.3), 0.5},
      {dead_zone("dead zone from zero", false, 0.0), 0.5},
      {dead_zone("shifted dead zone from zero", true, 0.0), 0.5},
      {called("upper part", [=](double u) { return std::max(u - edge, 0.0); }), 0.25},
      {called("lower part", [=](double u) { return std::min(u + edge, 0.0); }), 0.25},
      {called("pieces", [=](double u) { return u > edge    ? 1.0
                                               : u < -edge ? -1.0
                                                           : 0.0; }), 0.5},
      {{"pulse",
        [](DiagramBuilder& b) { return &b.add<Pulse>("held", Pulse::Options{.period = pi}); }},
       0.5},
  };
  const auto method = GENERATE(Method::taylor, from_range(methods));
  const bool with_switch = GENERATE(false, true);
  for (const auto& [condition, part] : conditions) {
    if (condition.called && method == Method::taylor) continue;
    INFO(condition.name << ", method " << method << ", switch " << with_switch);
    const double expected = 4.0 * pi * (2.0 * part - 1.0);
    // Some eight edges, each located within some roundings of the time, on either side of a jump by 2.
    CHECK(std::abs(run(condition, with_switch, 4.0 * pi, method).integral - expected) < 1e-11);
  }
}
