// Rates, and the lists they make: what is constant, held, continuous; what the derivatives, guards
// and taps need.
#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("the own rate of a value is that of the fastest thing it reads", "[rate]") {
  CHECK(own_rate(Reads::parameters, true, true, true) == Rate::constant);
  CHECK(own_rate(Reads::time, false, false, false) == Rate::continuous);
  CHECK(own_rate(Reads::continuous_state, true, false, false) == Rate::continuous);
  CHECK(own_rate(Reads::continuous_state, false, false, false) == Rate::constant);
  CHECK(own_rate(Reads::discrete_state, true, true, false) == Rate::held);
  CHECK(own_rate(Reads::discrete_state, true, false, false) == Rate::constant);
  CHECK(own_rate(Reads::mode, false, false, true) == Rate::held);
  CHECK(own_rate(Reads::schedule, false, false, false) == Rate::held);
  CHECK(own_rate(Reads::discrete_state | Reads::time, false, true, false) == Rate::continuous);
  CHECK(faster(Rate::held, Rate::constant) == Rate::held);
  CHECK(faster(Rate::held, Rate::continuous) == Rate::continuous);
}

namespace {

/// constant, held and continuous through a gain each, and what they make together.
struct Rates {
  DiagramBuilder builder;
  Gain *constant, *held, *continuous;
  Adder *slow, *fast;
  std::unique_ptr<Diagram> diagram;

  Rates() {
    const auto chain = [&](auto& source, const char* name) {
      auto& gain = builder.add<Gain>(name, 2.0);
      builder.connect(source.output(), gain.input());
      return &gain;
    };
    constant = chain(builder.add<Constant>("one", 1.0), "constant");
    held = chain(builder.add<Step>("step"), "held");
    continuous = chain(builder.add<Sine>("sine"), "continuous");
    slow = &builder.add<Adder>("slow"), fast = &builder.add<Adder>("fast");
    builder.connect(constant->output(), slow->input(0)),
        builder.connect(held->output(), slow->input(1));
    builder.connect(slow->output(), fast->input(0)),
        builder.connect(continuous->output(), fast->input(1));
    diagram = std::make_unique<Diagram>(builder.build());
  }
};

std::vector<std::string> names(const Plan& plan, const std::vector<int>& nodes) {
  std::vector<std::string> list;
  for (const int i : nodes) list.push_back(plan.name_of(plan.node(i)));
  std::ranges::sort(list);
  return list;
}
using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("the rate of an output is the fastest of its own and its inputs'", "[rate]") {
  const Rates rates;
  const auto plan = compile(*rates.diagram, {{"c", rates.constant->output()},
                                             {"h", rates.held->output()},
                                             {"x", rates.continuous->output()},
                                             {"s", rates.slow->output()},
                                             {"f", rates.fast->output()}});
  const Rate expected[] = {Rate::constant, Rate::held, Rate::continuous, Rate::held,
                           Rate::continuous};
  for (std::size_t i = 0; i < 5; ++i) CHECK(plan->node(plan->taps[i].node).rate == expected[i]);
}

TEST_CASE("taps pull what they need at each rate, and nothing else", "[needs]") {
  const Rates rates;
  const auto none = compile(*rates.diagram);
  CHECK((none->constants.empty() && none->instants.empty() && none->tap_needs.empty() &&
         none->derivatives.empty()));
  const auto slow = compile(*rates.diagram, {{"s", rates.slow->output()}});
  CHECK(names(*slow, slow->constants) == Names{"constant.out"});
  CHECK(names(*slow, slow->instants) == Names{"held.out", "slow.out", "step.out"});
  CHECK(slow->tap_needs.empty());
  const auto fast = compile(*rates.diagram, {{"f", rates.fast->output()}});
  CHECK(names(*fast, fast->tap_needs) == Names{"continuous.out", "fast.out", "sine.out"});
}

TEST_CASE("a relation between held values moves at instants only and is no guard", "[needs]") {
  DiagramBuilder builder;
  auto& step = builder.add<Step>("step");
  auto& half = builder.add<Constant>("half", 0.5);
  auto& above = builder.add<Comparator>("above", ">");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.connect(step.output(), above.input(0)), builder.connect(half.output(), above.input(1));
  builder.connect(above.output(), integrator.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  CHECK(plan->guards.empty());
  CHECK(names(*plan, plan->restarting) == Names{"above.out"});
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 3.0});
  CHECK(std::abs(results.context.continuous_state()[0] - 2.0) < 1e-9);
}

TEST_CASE("an opaque boolean that reaches a derivative is located, and describe says so",
          "[describe]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& above = builder.add<FunctionBlock>("above", [](double u) { return u > 0.5; });
  auto& integrator = builder.add<Integrator>("integrator");
  builder.connect(sine.output(), above.input()),
      builder.connect(above.output(), integrator.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  REQUIRE(plan->guards.size() == 1);
  CHECK(plan->guards[0].kind == GuardGroup::Kind::opaque);
  CHECK(contains(
      plan->describe(),
      "block 'above' is an opaque boolean: located by bisection; a Comparator would be faster"));
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 3.0});
  CHECK(std::abs(results.context.continuous_state()[0] - 2.0 * std::acos(-1.0) / 3.0) < 1e-8);
}

TEST_CASE("describe counts blocks, states, outputs, guards and time events", "[describe]") {
  const Rates rates;
  const std::string what = compile(*rates.diagram, {{"f", rates.fast->output()}})->describe();
  CHECK(contains(what, "plan: 8 blocks, 0 continuous and 0 discrete states"));
  CHECK(contains(what, "outputs: 8"));
  CHECK(contains(what, "views of a state or parameter, never copied: 1 (one.out)"));
  CHECK(contains(what, "recorded signals: 1"));
  CHECK(contains(what, "time events: 1"));
}
