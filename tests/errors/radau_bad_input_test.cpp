// What radau does with bad input: it ends right, and the statistics say what was wrong, or with an
// error that names block, state and time.
#include "saltus/solver/detail/radau/tables.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double lambda = 1e3, rtol = 1e-6;

/// x' = -lambda (x^3 - cos^3 t) - sin t, x = cos t, with `share` times the right Jacobian.
Leaf declared(double share) {
  return Leaf("leaf", [share](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}),
         .ode =
             [](const At& at) {
               return -lambda * (std::pow(at.x[0], 3) - std::pow(std::cos(at.time), 3)) -
                      std::sin(at.time);
             },
         .jacobian = [share](const At& at,
                             MatrixRef j) { j << -3.0 * lambda * share * at.x[0] * at.x[0]; }});
  });
}

Results run(const Leaf& leaf, double h = 0.0) {
  SimulatorOptions options{.rtol = rtol, .atol = rtol, .ode_solver_method = Method::radau};
  if (h > 0.0) options.first_step = h, options.max_minor_step_size = h;
  return simulate(leaf, leaf.create_context(), {0.0, 1.0}, options);
}

double error(const Results& results, double exact) {  // [tolerances]
  return std::abs(results.context.continuous_state()[0] - exact) / (rtol * (1.0 + exact));
}

}  // namespace

TEST_CASE("a wrong Jacobian is found, and differences take its place", "[radau][errors]") {
  const double share = GENERATE(-1.0, 10.0, 0.1, 0.0, 100.0, 0.01, 1e6, -1e6, 1e300);
  INFO(share << " times the right one");
  const Results right = run(declared(1.0)), wrong = run(declared(share));
  CHECK(error(wrong, std::cos(1.0)) < 2.0);  // see fast_error
  // Without them each step fails once and is short: 1 100 to 3 500 steps, 3e8 for 1e6. The search
  // takes ten failures and as many short steps.
  CHECK(wrong.statistics.steps < right.statistics.steps + 30);
  INFO(wrong.statistics.linear_solver);
  CHECK(
      contains(wrong.statistics.linear_solver, "entry (0, 0) of the Jacobian of block 'leaf' was"));
  CHECK(contains(wrong.statistics.linear_solver, "and the difference"));
  CHECK_FALSE(contains(right.statistics.linear_solver, "Jacobian of block"));
}

TEST_CASE("a Jacobian that is not finite is replaced, and named", "[radau][errors]") {
  const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), infinite, -infinite);
  const Results results = run(declared(bad));
  CHECK(error(results, std::cos(1.0)) < 2.0);
  CHECK(contains(results.statistics.linear_solver,
                 "entry (0, 0) of the Jacobian of block 'leaf' was not finite at t = 0 s"));
}

TEST_CASE("a matrix that is singular makes the step shorter", "[radau][errors]") {
  // gamma - h J = 0 for the real eigenvalue gamma of three stages, with a right and a false
  // Jacobian.
  const double gamma = RadauTable<3>::gamma, h = 0.0625, rate = gamma / h;
  for (const double slope : {rate, -1.0}) {
    const Leaf leaf("leaf", [=](Leaf& l) {
      l.declare_continuous_state({.initial = vec({1.0}),
                                  .ode = [slope](const At& at) { return slope * at.x[0]; },
                                  .jacobian = [rate](const At&, MatrixRef j) { j << rate; }});
    });
    // Relative errors add up over some 60 steps.
    CHECK(error(run(leaf, h), std::exp(slope)) < 60.0);
  }
}

TEST_CASE("a solution that no step passes ends with block, state and time", "[radau][errors]") {
  const auto says = [](auto ode) {
    const Leaf leaf(
        "leaf", [&](Leaf& l) { l.declare_continuous_state({.initial = vec({0.3}), .ode = ode}); });
    return message<SimulationError>([&] { run(leaf); });
  };
  // Newton's iteration never converges on the jump at 0, where the solution slides.
  const auto slides = says([](const At& at) { return at.x[0] > 0.0 ? -1.0 : 1.0; });
  CHECK(contains(slides, "t = 0.30"));
  CHECK(contains(slides, "state x[0] of block 'leaf' jumps"));
  CHECK(contains(slides, "guard"));
  const auto ends = says([](const At& at) { return at.time > 0.5 ? std::sqrt(-1.0) : -at.x[0]; });
  CHECK(contains(ends, "t = 0.49"));
  CHECK(contains(ends, "block 'leaf' is not finite"));
  CHECK(contains(ends, "xdot[0] = "));
}

TEST_CASE("a jump of a fast right-hand side without a guard is passed", "[radau][errors]") {
  // The part that follows forgets the error at the jump.
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At& at) {
                                  return -1e3 * (at.x[0] - (at.time > 0.4321 ? 1.0 : 0.0));
                                }});
  });
  CHECK(error(run(leaf), 1.0) < 2.0);
}
