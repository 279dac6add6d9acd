// The longest step and the longest stretch without an instant are what the options say.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

Leaf van_der_pol(double mu) {
  return Leaf("van_der_pol", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({2.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], mu * (1.0 - at.x[0] * at.x[0]) * at.x[1] - at.x[0];
         }});
    l.declare_continuous_state_output("x");
  });
}

}  // namespace

TEST_CASE("no step is longer than max_minor_step_size", "[laws][step_limits]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = van_der_pol(1.0);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 5.0},
                                {.ode_solver_method = method,
                                 .max_minor_step_size = 0.03,
                                 .recorded_signals = {{"x", leaf.output()}}});
  for (std::size_t i = 1; i < results.time.size(); ++i)
    CHECK(results.time[i] - results.time[i - 1] <= 0.03 + 5.0 * eps);  // of times up to 5 s
}

TEST_CASE("no instant is further off than max_major_step_length", "[laws][step_limits]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = van_der_pol(1.0);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 5.0},
                                {.ode_solver_method = method, .max_major_step_length = 0.1});
  CHECK(results.statistics.instants >= 50);
  CHECK(results.events.empty());
}
