// Radau over jumps and kinks of the derivative that no guard locates: the error is of the size of the
// tolerance, because an estimate that does not show its order is believed.
#include <cmath>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace radau_jumps_test {

constexpr double jump = 2.2, end = 6.0;

/// x'' = -x + f(t), with f = 0 until `jump` and then 1, t - jump or (t - jump)^2.
Leaf oscillator(int power) {
  return Leaf("oscillator", [power](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.5}), .ode = [power](const At& at, VectorRef xdot) {
           const double since = at.time - jump;
           xdot << at.x[1], -at.x[0] + (since > 0.0 ? std::pow(since, power) : 0.0);
         }});
  });
}

/// x(end): the free oscillation, and the response r'' = -r + s^n from rest: 1 - cos s, s - sin s,
/// s^2 - 2 + 2 cos s.
double exact(int power) {
  const double s = end - jump;
  const double response[] = {1.0 - std::cos(s), s - std::sin(s), s * s - 2.0 + 2.0 * std::cos(s)};
  return std::cos(end) + 0.5 * std::sin(end) + response[power];
}

}  // namespace radau_jumps_test

using namespace radau_jumps_test;

TEST_CASE("radau resolves a jump, a kink and a bend that no guard locates", "[laws]") {
  const int power = GENERATE(0, 1, 2);
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8, 1e-10);
  INFO("(t - jump)^" << power << ", rtol " << rtol);
  const Leaf leaf = oscillator(power);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, end},
                                {.rtol = rtol, .atol = rtol, .ode_solver_method = Method::radau});
  // Some twenty steps, each with at most the error rtol (1 + |x|), |x| < 16; at a bend the estimate
  // shows part of its order, and may be as many times too small.
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(exact(power), 100.0 * rtol));
}
