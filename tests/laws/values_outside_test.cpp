// Values outside of the system that one function writes and others read: Next::note_write_outside,
// Reads::outside, declare_shared_outside.
#include <memory>

#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace values_outside_test {

using Shared = std::shared_ptr<double>;

/// Adds 1 to the value at 1, 2, 3 and 4 s, and leaves its own state as it is.
auto writes(const Shared& k) {
  return [k](Leaf& l) {
    declare_ramp(l);
    l.declare_periodic_update(
        [k](const At&, Next& next) {
          *k += 1.0;
          next.note_write_outside();
        },
        1.0, 1.0);
    l.declare_shared_outside();
  };
}

auto reads(const Shared& k) {
  return [k](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [k](const At&, VectorRef xdot) { xdot[0] = *k; }});
    l.declare_shared_outside();
  };
}

/// An output that would be computed once, if it did not say what it reads.
auto shows(const Shared& k) {
  return [k](Leaf& l) {
    l.declare_output_port({.name = "out",
                           .calc = [k](const At&, VectorRef out) { out[0] = *k; },
                           .reads = Reads::outside});
    l.declare_shared_outside();
  };
}

/// With k = 1, 2, ... 5 in the five pieces x(4.5) = 1 + 2 + 3 + 4 + 2.5. Every method is exact on a
/// straight line, to the rounding of some steps.
constexpr double expected = 12.5, rounding = 1e-9;

}  // namespace values_outside_test

using namespace values_outside_test;

TEST_CASE("a derivative that reads a written value begins anew", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const bool islands = GENERATE(false, true);
  INFO("method " << method << ", islands " << islands);
  const auto k = std::make_shared<double>(1.0);
  DiagramBuilder builder;
  builder.add<Leaf>("writer", writes(k)), builder.add<Leaf>("reader", reads(k));
  const Diagram diagram = builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 4.5},
                                {.ode_solver_method = method, .islands = islands});
  CHECK_THAT(results.context.continuous_state()[1], WithinAbs(expected, rounding));
}

TEST_CASE("an output that reads a written value is computed again", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto k = std::make_shared<double>(1.0);
  DiagramBuilder builder;
  builder.add<Leaf>("writer", writes(k));
  auto& from = builder.add<Leaf>("source", shows(k));
  auto& x = builder.add<Integrator>("x");
  builder.connect(from.output(), x.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 4.5}, {.ode_solver_method = method});
  CHECK_THAT(results.context.continuous_state()[1], WithinAbs(expected, rounding));
}
