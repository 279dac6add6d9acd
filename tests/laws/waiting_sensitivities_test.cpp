// Derivatives of what waits: deliveries of event wires, and executions of queued zero crossings.
#include <cmath>

#include "saltus/simulation/simulator.hpp"
#include "support/cells.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr auto every_method = {Method::dopri5, Method::dop853, Method::radau,
                               Method::taylor, Method::adams,  Method::bdf};

/// v' = I - v from 0 fires at v = 1, which sets it to 0. A delivery adds its weight times `gain`.
Leaf neuron(const std::string& name, double current, double start = 0.0) {
  return Leaf(name, [=](Leaf& l) {
    const ParameterIndex i = l.declare_dynamic_parameter("I", current);
    const ParameterIndex gain = l.declare_dynamic_parameter("gain", 1.0);
    l.declare_continuous_state({.initial = vec({start}), .formula = Formula([=](const auto& at) {
                                                           return at.p(i, 0) - at.x(0);
                                                         })});
    l.declare_continuous_state_output("v");
    l.declare_zero_crossing(
        {.name = "fire",
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::negative_then_non_negative,
         .formula = Formula([](const auto& at) { return at.x(0) - 1.0; })});
    l.declare_event_input({.name = "synapse", .reset_map = [=](const At& at, Delivery& next) {
                             next.set_continuous_state({at.x[0] + next.weight() * at.p[gain]});
                           }});
  });
}

SimulatorOptions tight(std::vector<std::string> by, Method method = Method::dopri5) {
  SimulatorOptions options{.rtol = 1e-11, .atol = 1e-13, .ode_solver_method = method};
  options.sensitivity = std::move(by);
  return options;
}

/// The derivatives of the time of firing number n of an event, one for each parameter.
std::vector<double> by_time(const Results& results, const std::string& event, std::size_t n = 0) {
  const std::size_t m = results.sensitivities.size();
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const Event one = results.events[i];
    if (joined_name(one.block, one.name) != event || n-- > 0) continue;
    const auto first =
        results.sensitivities.event_times.begin() + static_cast<std::ptrdiff_t>(i * m);
    return {first, first + static_cast<std::ptrdiff_t>(m)};
  }
  return {};
}

void check_close(const std::vector<double>& found, const std::vector<double>& expected,
                 double allowed) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO("parameter " << i << ": found " << found[i] << ", expected " << expected[i]);
    CHECK(std::abs(found[i] - expected[i]) <= allowed);
  }
}

}  // namespace

TEST_CASE("the spike of a cell moves with the current of the cell that kicks it, in closed form",
          "[sensitivity][events]") {
  const Method method = GENERATE(values(every_method));
  INFO("method " << to_string(method));
  const double a = 2.0, b = 1.5, w = 0.1, delay = 0.1;
  Network network;
  network.add(neuron("a", a)), network.add(neuron("b", b));
  network.wire("a", "fire", "b", "synapse", w, delay);
  const Diagram scene = network.builder.build();
  const Results results =
      simulate(scene, scene.create_context(), {0.0, 0.95}, tight({"a.I", "b.I", "b.gain"}, method));
  REQUIRE(results.sensitivities.gaps.empty());
  // a fires at ln(a / (a - 1)); the kick at s is `delay` later; v = b (1 - e^-t) + w e^(s - t) = 1
  // at t = ln((b - w e^s) / (b - 1)).
  const double s = std::log(a / (a - 1.0)) + delay, kick = w * std::exp(s), rest = b - kick;
  const double by_s = -kick / rest, by_a = -1.0 / (a * (a - 1.0));
  // a hundred tolerances; the sum of the errors of some hundred steps of a multistep method, and
  // the differences of the reset map, 1e-10
  const double allowed = method == Method::bdf || method == Method::adams ? 1e-6 : 1e-8;
  check_close(by_time(results, "a.fire"), {by_a, 0.0, 0.0}, allowed);
  check_close(by_time(results, "b.fire"),
              {by_s * by_a, 1.0 / rest - 1.0 / (b - 1.0), -std::exp(s) * w / rest}, allowed);
}

TEST_CASE("a delivery without a delay that carries a cell over its threshold moves with its source",
          "[sensitivity][events]") {
  Network network;
  network.add(neuron("a", 2.0)), network.add(neuron("b", 1.1)), network.add(neuron("c", 1.1));
  network.wire("a", "fire", "b", "synapse", 5.0);
  network.wire("b", "fire", "c", "synapse", 5.0, 0.25);
  const Diagram scene = network.builder.build();
  const Results results =
      simulate(scene, scene.create_context(), {0.0, 1.2}, tight({"a.I", "b.I", "c.I"}));
  REQUIRE(results.sensitivities.gaps.empty());
  for (const char* event : {"a.fire", "b.fire", "c.fire"})
    check_close(by_time(results, event), {-0.5, 0.0, 0.0}, 1e-9);
  // After its reset c is I (1 - e^(s - t)): at a fixed time ds/da times I e^(s - t), and by I.
  const double past = 1.2 - (std::log(2.0) + 0.25);
  const auto& by = results.sensitivities.continuous_state;
  check_close({by[6], by[7], by[8]}, {0.5 * 1.1 * std::exp(-past), 0.0, 1.0 - std::exp(-past)},
              1e-8);
}

TEST_CASE("deliveries wait over other events, and keep the derivative of their firing",
          "[sensitivity][events]") {
  // The cell fires each ln 2 and its deliveries arrive 3 ln 2 / 2 later, between other firings. Each
  // adds 1 to a counter and its time to a clock.
  Network network;
  network.add(neuron("a", 2.0));
  network.add(Leaf("log", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_event_input({.name = "note", .reset_map = [](const At& at, Delivery& next) {
                             next.set_discrete_state({at.z[0] + 1.0, at.z[1] + at.time});
                           }});
  }));
  network.wire("a", "fire", "log", "note", 1.0, 1.5 * std::log(2.0));
  const Diagram scene = network.builder.build();
  const auto run = [&](const std::vector<double>& ends) {
    Simulator simulator(scene, tight({"a.I"}));
    simulator.initialize(scene.create_context());
    for (const double t : ends) simulator.advance_to(t);
    return simulator.results();
  };
  for (const Results& results : {run({6.0}), run({0.5, 1.0, 2.3, 2.9, 6.0})}) {
    REQUIRE(results.sensitivities.gaps.empty());
    // Firing n is at n ln(I / (I - 1)); seven of them arrive before t = 6: the sum of n is 28.
    CHECK(results.context.discrete_state()[0] == 7.0);
    const auto& by = results.sensitivities.discrete_state;
    check_close({by[0], by[1]}, {0.0, -28.0 / 2.0}, 1e-8);
  }
}

TEST_CASE("a run that begins with waiting deliveries gets them at fixed times",
          "[sensitivity][events]") {
  Network network;
  network.add(neuron("a", 2.0)), network.add(neuron("b", 1.2));
  network.wire("a", "fire", "b", "synapse", 0.1, 0.5);
  const Diagram scene = network.builder.build();
  const Results first = simulate(scene, scene.create_context(), {0.0, 0.9}, tight({}));
  const Results second = simulate(scene, first.context, {0.9, 1.3}, tight({"a.I", "b.I"}));
  REQUIRE(second.sensitivities.gaps.empty());
  const auto& by = second.sensitivities.continuous_state;
  // The kick is at a fixed time, and adds a constant.
  check_close({by[2], by[3]}, {0.0, 1.0 - std::exp(-0.4)}, 1e-9);
}

TEST_CASE("time events deliver at fixed times", "[sensitivity][events]") {
  Network network;
  network.add(beats("beats", {0.25})), network.add(neuron("b", 1.5));
  network.wire("beats", "beat", "b", "synapse", 0.2, 0.25);
  const Diagram scene = network.builder.build();
  const Results results =
      simulate(scene, scene.create_context(), {0.0, 0.75}, tight({"b.I", "b.gain", "b.x"}));
  REQUIRE(results.sensitivities.gaps.empty());
  check_close(results.sensitivities.continuous_state,
              {1.0 - std::exp(-0.75), 0.2 * std::exp(-0.25), std::exp(-0.75)}, 1e-9);
}

TEST_CASE("deliveries that are due together are a tie where their times move apart",
          "[sensitivity][events]") {
  const auto gaps = [](const std::string& by) {
    Network network;
    network.add(neuron("a", 2.0)), network.add(neuron("b", 2.0)), network.add(neuron("c", 1.1));
    network.wire("a", "fire", "c", "synapse", 0.1, 0.1);
    network.wire("b", "fire", "c", "synapse", 0.1, 0.1);
    const Diagram scene = network.builder.build();
    const Results results = simulate(scene, scene.create_context(), {0.0, 1.0}, tight({by}));
    CHECK(std::isnan(results.sensitivities.continuous_state[2]) ==
          !results.sensitivities.gaps.empty());
    return results.sensitivities.gaps;
  };
  const auto tie = gaps("a.I");
  REQUIRE(tie.size() == 1);
  CHECK(tie[0].reason.find("their order would change") != std::string::npos);
  CHECK(gaps("c.I").empty());
}

TEST_CASE("a delivery and a firing at one time are a tie where they move apart",
          "[sensitivity][events]") {
  Network network;
  network.add(beats("beats", {0.5}));
  network.add(Leaf("a", [](Leaf& l) {
    const ParameterIndex i = l.declare_dynamic_parameter("I", 2.0);
    l.declare_dynamic_parameter("other", 2.0);
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [=](const At& at) { return at.p[i]; }});
    l.declare_zero_crossing(
        {.name = "fire",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::negative_then_non_negative});
    l.declare_event_input({.name = "synapse", .reset_map = [](const At& at, Delivery& next) {
                             next.set_continuous_state({at.x[0] + next.weight()});
                           }});
  }));
  network.wire("beats", "beat", "a", "synapse", -0.5, 0.0);
  const Diagram scene = network.builder.build();
  const Results results =
      simulate(scene, scene.create_context(), {0.0, 1.0}, tight({"a.I", "a.other"}));
  REQUIRE(results.sensitivities.gaps.size() == 1);
  CHECK(results.sensitivities.gaps[0].parameter == "a.I");
}

// --- queued zero crossings

namespace {

/// x' = r from 0; `cross` at x = 1 is executed c later, and takes x to q x.
Leaf queued(bool frozen) {
  return Leaf("leaf", [=](Leaf& l) {
    const ParameterIndex r = l.declare_dynamic_parameter("r", 2.0);
    const ParameterIndex q = l.declare_dynamic_parameter("q", 0.25);
    const ParameterIndex c = l.declare_dynamic_parameter("c", 0.3);
    l.declare_continuous_state(
        {.initial = vec({0.0}), .formula = Formula([=](const auto& at) { return at.p(r, 0); })});
    l.declare_zero_crossing(
        {.name = "cross",
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({at.p[q] * at.x[0] * at.x[0]}); },
         .direction = Direction::negative_then_non_negative,
         .formula = Formula([](const auto& at) { return at.x(0) - 1.0; }),
         .delay = NumberOf([=](const At& at) { return at.p[c] * at.x[0] * at.x[0]; }),
         .use_values_from_trigger_time = frozen});
  });
}

}  // namespace

TEST_CASE("an execution moves with its trigger and its delay, in closed form",
          "[sensitivity][queue]") {
  const Method method = GENERATE(values(every_method));
  INFO("method " << to_string(method));
  const Leaf leaf = queued(false);
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, tight({"r", "q", "c"}, method));
  REQUIRE(results.sensitivities.gaps.empty());
  const double r = 2.0, q = 0.25, c = 0.3, high = 1.0 + r * c;
  // executed at s = 1 / r + c with x = 1 + r c; after that x = q (1 + r c)^2 + r (1 - s)
  const double allowed = method == Method::bdf || method == Method::adams ? 1e-7 : 1e-9;
  check_close(results.sensitivities.continuous_state,
              {2.0 * q * high * c + 1.0 - c, high * high, 2.0 * q * high * r - r}, allowed);
  check_close(by_time(results, "leaf.cross", 0), {-1.0 / (r * r), 0.0, 0.0}, allowed);
  check_close(by_time(results, "leaf.cross", 1), {-1.0 / (r * r), 0.0, 1.0}, allowed);
}

TEST_CASE("values of the trigger time keep the derivatives of the trigger",
          "[sensitivity][queue]") {
  const Leaf leaf = queued(true);
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, tight({"r", "q", "c", "x[0]"}));
  REQUIRE(results.sensitivities.gaps.empty());
  // x = q + r (1 - 1 / r - c) at the end: by x(0) it moves the trigger by -1 / r
  check_close(results.sensitivities.continuous_state, {1.0 - 0.3, 1.0, -2.0, 1.0}, 1e-9);
}

namespace {

/// Two ramps with slopes a and b cross 1 together; each is executed `delay` later with a priority.
Leaf two_ramps(NumberOf first_priority, NumberOf second_priority) {
  return Leaf("leaf", [=](Leaf& l) {
    const ParameterIndex a = l.declare_dynamic_parameter("a", 2.0);
    const ParameterIndex b = l.declare_dynamic_parameter("b", 2.0);
    l.declare_dynamic_parameter("one", 1.0), l.declare_dynamic_parameter("two", 1.0);
    l.declare_discrete_state(vec({0.0}));
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [=](const At& at, VectorRef xdot) { xdot << at.p[a], at.p[b]; }});
    for (const Index i : {Index{0}, Index{1}})
      l.declare_zero_crossing({.name = i == 0 ? "first" : "second",
                               .guard = [i](const At& at) { return at.x[i] - 1.0; },
                               .reset_map =
                                   [i](const At& at, Next& next) {
                                     next.set_discrete_state(
                                         {10.0 * at.z[0] + static_cast<double>(i) + 1.0});
                                   },
                               .direction = Direction::negative_then_non_negative,
                               .delay = 0.25,
                               .priority = i == 0 ? first_priority : second_priority});
  });
}

std::vector<std::string> lost(const Leaf& leaf, const std::vector<std::string>& by) {
  const Results results = simulate(leaf, leaf.create_context(), {0.0, 1.0}, tight(by));
  std::vector<std::string> names;
  for (const SensitivityGap& gap : results.sensitivities.gaps) names.push_back(gap.parameter);
  std::ranges::sort(names);
  return names;
}

}  // namespace

TEST_CASE("executions that are due together are a tie where their times move apart",
          "[sensitivity][queue]") {
  const Leaf leaf = two_ramps(2.0, 1.0);
  CHECK(lost(leaf, {"a", "b", "one"}) == std::vector<std::string>{"a", "b"});
}

TEST_CASE("equal priorities are a tie where they move apart", "[sensitivity][queue]") {
  const auto of = [](Index k) {
    return NumberOf([k](const At& at) { return at.p[static_cast<std::size_t>(k)]; });
  };
  CHECK(lost(two_ramps(of(2), of(3)), {"one", "two"}) == std::vector<std::string>{"one", "two"});
  CHECK(lost(two_ramps(of(2), of(2)), {"one", "two"}).empty());
  CHECK(lost(two_ramps(1.0, 1.0), {"one", "two"}).empty());
}

TEST_CASE("a delay of zero that moves has no derivative, and a constant one has",
          "[sensitivity][queue]") {
  const auto by = [](bool moves) {
    const Leaf leaf("leaf", [=](Leaf& l) {
      const ParameterIndex c = l.declare_dynamic_parameter("c", 0.0);
      l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.5; }});
      l.declare_zero_crossing(
          {.name = "cross",
           .guard = [](const At& at) { return at.x[0] - 1.0; },
           .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
           .direction = Direction::negative_then_non_negative,
           .delay = moves ? NumberOf([=](const At& at) { return at.p[c] * at.p[c] + at.p[c]; })
                          : NumberOf(0.0)});
    });
    return lost(leaf, {"c", "x[0]"});
  };
  CHECK(by(true) == std::vector<std::string>{"c"});
  CHECK(by(false).empty());
}

TEST_CASE("a value that a trigger leaves as it was, and that would be written beside it, is a gap",
          "[sensitivity][queue]") {
  const auto gaps = [](double value) {
    const Leaf leaf("leaf", [=](Leaf& l) {
      const ParameterIndex v = l.declare_dynamic_parameter("v", value);
      l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.0; }});
      l.declare_discrete_state(vec({3.0}));
      l.declare_zero_crossing(
          {.name = "cross",
           .guard = [](const At& at) { return at.x[0] - 0.5; },
           .reset_map = [=](const At& at, Next& next) { next.set_discrete_state({at.p[v]}); },
           .direction = Direction::negative_then_non_negative,
           .delay = 0.25,
           .use_values_from_trigger_time = true});
    });
    return lost(leaf, {"v"}).size();
  };
  CHECK(gaps(3.0) == 1);
  CHECK(gaps(4.0) == 0);
}
