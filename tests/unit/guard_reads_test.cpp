// The signals that are looked at with the guards that read them.
#include "saltus/plan/compile.hpp"
#include "support/cases.hpp"
#include "support/oscillator.hpp"

using namespace saltus;
using namespace support;

namespace {

/// The slots behind those of the guards, of a leaf whose called guard reads the output of a block.
template <class Source>
Index reads(const std::shared_ptr<Source>& source, Index size = 1) {
  const auto reader = make_leaf("reader", [=](Leaf& l) {
    const int in =
        l.declare_input_port({.name = "u", .shape = size == 1 ? Shape::scalar() : Shape::of(size)});
    l.declare_zero_crossing({.name = "hit", .guard = [=](const At& at) { return at.u[in][0]; }});
  });
  DiagramBuilder builder;
  builder.add(source), builder.add(reader);
  builder.connect(source->output(), reader->input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  return plan->look_slots - plan->guard_slots;
}

std::shared_ptr<LeafSystem> called_reader() {
  return make_leaf("reader", [](Leaf& l) {
    const int in = l.declare_input_port({.name = "u", .shape = Shape::scalar()});
    l.declare_zero_crossing({.name = "hit", .guard = [=](const At& at) { return at.u[in][0]; }});
  });
}

std::shared_ptr<LeafSystem> called_stairs() {
  return std::make_shared<FunctionBlock>("stairs", [](double u) { return std::floor(5.0 * u); });
}

/// The slots behind the guard of a reader that reads a function of a sine.
Index reads_behind(const std::shared_ptr<LeafSystem>& function,
                   const std::shared_ptr<LeafSystem>& reader) {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{});
  // Its derivative has the guard of a control port located.
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.add(function), builder.add(reader);
  builder.connect(sine.output(), function->input());
  builder.connect(function->output(), reader->input());
  if (!reader->output_names().empty())
    builder.connect(reader->output(), x.input());
  else
    builder.connect(sine.output(), x.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  return plan->look_slots - plan->guard_slots;
}

/// A continuous vector.
std::shared_ptr<Leaf> waves(Index size) {
  return make_leaf("waves", [=](Leaf& l) {
    l.declare_output_port({.name = "out",
                           .calc = [](const At& at, VectorRef y) { y.setConstant(at.time); },
                           .shape = Shape::of(size)});
  });
}

}  // namespace

TEST_CASE("a called guard has the values that vary by themselves", "[plan]") {
  CHECK(reads(std::make_shared<Sine>("sine")) == 1);
  CHECK(reads(waves(3), 3) == 3);
}

TEST_CASE("it has what these are computed from, too", "[plan]") {
  CHECK(reads_behind(called_stairs(), called_reader()) == 2);
}

TEST_CASE("a formula has what is behind a function that may be constant", "[plan]") {
  const auto formula = std::make_shared<ControlPort>("port");
  const auto smooth = std::make_shared<Gain>("gain", 2.0);
  const auto sign = std::make_shared<FunctionBlock>(
      "sign", Formula([](const auto& at) { return 2.0 * (at.u(0) > 0.0) - 1.0; }));
  CHECK(reads_behind(called_stairs(), formula) == 1);
  CHECK(reads_behind(sign, formula) == 1);
  CHECK(reads_behind(smooth, formula) == 0);
}

/// Python's blocks have no other outputs of states.
TEST_CASE("it has no formulas that only copy a state", "[plan]") {
  const auto times = [](double factor) {
    return make_leaf("state", [=](Leaf& l) {
      declare_oscillator(l);
      const auto formula = [=](const auto& at, Index i) {
        return factor == 1.0 ? at.x(i) : at.x(i) * factor;
      };
      l.declare_output_port({.name = "out", .shape = Shape::of(2), .formula = formula});
    });
  };
  CHECK(reads(times(1.0), 2) == 0);
  CHECK(reads(times(2.0), 2) == 2);
}

TEST_CASE("it has no states, no held signals, and 32 values at most", "[plan]") {
  const auto state = make_leaf("state", [](Leaf& l) {
    declare_oscillator(l);
    l.declare_continuous_state_output("out");
  });
  CHECK(reads(state, 2) == 0);
  CHECK(reads(std::make_shared<Step>("step", StepOptions{})) == 0);
  CHECK(reads(waves(32), 32) == 32);
  CHECK(reads(waves(33), 33) == 32);
}
