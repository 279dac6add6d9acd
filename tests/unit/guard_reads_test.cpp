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
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{});
  auto& stairs = builder.add<FunctionBlock>("stairs", [](double u) { return std::floor(5.0 * u); });
  const auto guard = make_leaf("reader", [](Leaf& l) {
    const int in = l.declare_input_port({.name = "u", .shape = Shape::scalar()});
    l.declare_zero_crossing({.name = "hit", .guard = [=](const At& at) { return at.u[in][0]; }});
  });
  builder.add(guard);
  builder.connect(sine.output(), stairs.input());
  builder.connect(stairs.output(), guard->input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  CHECK(plan->look_slots - plan->guard_slots == 2);
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
