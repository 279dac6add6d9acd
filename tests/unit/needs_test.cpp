// Needs: what derivatives, guards, instants and taps read is computed, and nothing else.
#include "saltus/plan/detail/needs.hpp"

#include "support/rates.hpp"

using namespace saltus;
using namespace support;

namespace {

std::vector<std::string> names(const Plan& plan, const std::vector<int>& nodes) {
  std::vector<std::string> list;
  for (const int i : nodes) list.push_back(plan.name_of(plan.node(i)));
  std::ranges::sort(list);
  return list;
}
using Names = std::vector<std::string>;

/// Nodes that read those listed.
Plan reading(const std::vector<std::vector<int>>& needs) {
  Plan plan;
  for (const auto& list : needs) {
    Node node;
    node.needs = list;
    plan.nodes.push_back(node);
  }
  return plan;
}

template <class Stop>
std::vector<int> marked(const Plan& plan, const std::vector<int>& from, Stop stop) {
  detail::Marks marks(plan.nodes.size());
  detail::spread(plan, from, marks, stop);
  std::vector<int> list;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) list.push_back(static_cast<int>(i));
  return list;
}

}  // namespace

TEST_CASE("marks spread to all that is read, once, and through loops", "[needs]") {
  const Plan plan = reading({{}, {0}, {1}, {1, 5}, {}, {3}});  // 3 and 5 read each other
  const auto never = [](const Node&) { return false; };
  CHECK(marked(plan, {2}, never) == std::vector{0, 1, 2});
  CHECK(marked(plan, {5}, never) == std::vector{0, 1, 3, 5});
  CHECK(marked(plan, {4, 4}, never) == std::vector{4});
  CHECK(marked(plan, {}, never).empty());
}

TEST_CASE("marks stop behind what is not computed again", "[needs]") {
  const Plan plan = reading({{}, {0}, {1}, {2}});
  const auto at_two = [&](const Node& node) { return &node == &plan.node(2); };
  CHECK(marked(plan, {3}, at_two) == std::vector{2, 3});
}

TEST_CASE("taps pull what they need at each rate, and nothing else", "[needs]") {
  const Rates rates;
  const auto none = compile(*rates.diagram);
  CHECK((none->needs.constants.empty() && none->needs.instants.empty() &&
         none->needs.taps.empty() && none->needs.derivatives.empty()));
  const auto slow = compile(*rates.diagram, {{"s", rates.slow->output()}});
  CHECK(names(*slow, slow->needs.constants) == Names{"constant.out"});
  CHECK(names(*slow, slow->needs.instants) == Names{"held.out", "slow.out", "step.out"});
  CHECK(slow->needs.taps.empty());
  const auto fast = compile(*rates.diagram, {{"f", rates.fast->output()}});
  CHECK(names(*fast, fast->needs.taps) == Names{"continuous.out", "fast.out", "sine.out"});
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
  CHECK(names(*plan, plan->needs.restarting) == Names{"above.out"});
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 3.0});
  CHECK(std::abs(results.context.continuous_state()[0] - 2.0) < 1e-9);
}

TEST_CASE("an opaque boolean that reaches a derivative is located, and describe says so",
          "[needs]") {
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
