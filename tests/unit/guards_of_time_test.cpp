// The guards of a plan that follow the time itself.
#include "saltus/plan/compile.hpp"
#include "support/cases.hpp"
#include "support/oscillator.hpp"

using namespace saltus;
using namespace support;

namespace {

/// What the plan knows of the first guard of a leaf alone.
FollowsTime of(ZeroCrossing crossing) {
  crossing.name = "hit";
  const Leaf leaf("leaf", [&](Leaf& l) {
    declare_oscillator(l);
    l.declare_zero_crossing(crossing);
  });
  return compile(leaf)->guards.front().follows_time;
}

/// The same of a block with one input that reads an output.
FollowsTime behind(const std::shared_ptr<LeafSystem>& source,
                   const std::shared_ptr<LeafSystem>& reader) {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.add(source), builder.add(reader);
  builder.connect(source->output(), reader->input());
  builder.connect(reader->output_names().empty() ? source->output() : reader->output(), x.input());
  const Diagram diagram = builder.build();
  return compile(diagram)->guards.front().follows_time;
}

std::shared_ptr<Leaf> reader(bool formula) {
  return make_leaf("reader", [=](Leaf& l) {
    l.declare_input_port({.name = "u"});
    ZeroCrossing hit{.name = "hit"};
    if (formula)
      hit.formula = Formula([](const auto& at) { return at.u(0) - 0.5; });
    else
      hit.guard = [](const At& at) { return at.u[0][0] - 0.5; };
    l.declare_zero_crossing(hit);
  });
}

/// A state, and its output: a view, or called with these reads.
std::shared_ptr<Leaf> state(std::optional<Reads> reads = {}) {
  return make_leaf("state", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.0; }});
    if (reads)
      l.declare_output_port(
          {.name = "out", .calc = [](const At& at) { return at.x[0]; }, .reads = *reads});
    else
      l.declare_continuous_state_output("out");
  });
}

const auto of_state = [](const auto& at) { return at.x(0) - 0.5; };
const auto of_time = [](const auto& at) { return at.x(0) - at.time(); };

}  // namespace

TEST_CASE("the expression of a guard says whether it follows the time", "[plan]") {
  CHECK(of({.formula = Formula(of_state)}) == FollowsTime::no);
  CHECK(of({.formula = Formula(of_time)}) == FollowsTime::yes);
}

TEST_CASE("a called guard may follow the time", "[plan]") {
  CHECK(of({.guard = [](const At& at) { return at.x[0] - 0.5; }}) == FollowsTime::perhaps);
}

TEST_CASE("a guard follows the time if a signal behind it does", "[plan]") {
  const auto sine = std::make_shared<Sine>("sine");
  CHECK(behind(sine, reader(true)) == FollowsTime::yes);
  CHECK(behind(sine, reader(false)) == FollowsTime::yes);
  CHECK(behind(sine, std::make_shared<ControlPort>("port")) == FollowsTime::yes);
  // The guard of an opaque boolean jumps, and the looks follow the signal that it reads.
  CHECK(behind(sine, std::make_shared<FunctionBlock>("above", [](double u) { return u > 0.3; })) ==
        FollowsTime::yes);
}

TEST_CASE("a guard of a state does not, nor one of a held signal", "[plan]") {
  CHECK(behind(state(), reader(true)) == FollowsTime::no);
  CHECK(behind(state(), reader(false)) == FollowsTime::perhaps);
  CHECK(behind(state(), std::make_shared<ControlPort>("port")) == FollowsTime::no);
  CHECK(behind(std::make_shared<Step>("step", StepOptions{}), reader(true)) == FollowsTime::no);
}

TEST_CASE("a called output says what it reads, or it may follow the time", "[plan]") {
  CHECK(behind(state(Reads::continuous_state), reader(true)) == FollowsTime::no);
  CHECK(behind(state(Reads::continuous_state | Reads::time), reader(true)) == FollowsTime::yes);
  CHECK(behind(state(Reads::everything), reader(true)) == FollowsTime::perhaps);
}
