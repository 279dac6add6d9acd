// Errors that add up in a fast oscillation that is hardly damped: adams and bdf say so.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A slow motion, x = cos(t) and y' = x - y, beside a fast oscillation that it does not excite.
Leaf slow_beside_fast(double rate, double damping) {
  const double pull = (rate * rate - 1.0) / (rate * rate);  // of cos(t), for x = cos(t)
  return Leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0, 0.0}), .ode = [=](const At& at, VectorRef f) {
           const double s = std::sin(at.time), c = std::cos(at.time);
           f << at.x[1], -rate * rate * (at.x[0] - pull * c) - 2.0 * damping * rate * (at.x[1] + s),
               at.x[0] - at.x[2];
         }});
  });
}

Results run(const Leaf& leaf, Method method, double rtol, double end) {
  return simulate(leaf, leaf.create_context(), {0.0, end},
                  {.rtol = rtol, .atol = 1e-2 * rtol, .ode_solver_method = method});
}

bool doubts(const Results& results) {
  return contains(results.statistics.method, "hardly damped") &&
         contains(results.statistics.method, "compare with radau");
}

}  // namespace

TEST_CASE("adams and bdf say where errors of a fast oscillation may add up", "[laws]") {
  const auto method = GENERATE(Method::adams, Method::bdf);
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8), rate = GENERATE(30.0, 100.0, 300.0);
  INFO(method << ", rtol " << rtol << ", rate " << rate);
  const Results results = run(slow_beside_fast(rate, 0.0), method, rtol, 10.0);
  CHECK(doubts(results));
  CHECK(results.statistics.stretches[0].method == to_string(method));
}

TEST_CASE("no doubt where the errors are damped, or the solution oscillates itself", "[laws]") {
  const auto method = GENERATE(Method::adams, Method::bdf);
  const double rtol = GENERATE(1e-3, 1e-4, 1e-6, 1e-8);
  INFO(method << ", rtol " << rtol);
  CHECK(run(slow_beside_fast(30.0, 1.0), method, rtol, 10.0).statistics.method ==
        to_string(method));
  const Leaf orbit("orbit", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.5, 0.0, 0.0, std::sqrt(3.0)}), .ode = [](const At& at, VectorRef f) {
           const double r = std::hypot(at.x[0], at.x[1]), cube = r * r * r;
           f << at.x[2], at.x[3], -at.x[0] / cube, -at.x[1] / cube;
         }});
  });
  CHECK(run(orbit, method, rtol, 60.0).statistics.method == to_string(method));
  const Leaf oscillator("oscillator", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0, 0.0}),
                                .ode = [](const At& at, VectorRef f) { f << at.x[1], -at.x[0]; }});
  });
  CHECK(run(oscillator, method, rtol, 300.0).statistics.method == to_string(method));
}
