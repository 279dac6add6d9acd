// Step sizes: the first, the next after an accepted step, the next after a rejected one.
#include "saltus/solver/detail/step_size.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinRel;

namespace {

/// Hairer, Wanner II, (2.43c) as it is printed, with the bounds of the factor.
double proportional_integral(double order, double beta, double error, double before) {
  const double factor =
      0.9 * std::pow(error, -(1.0 / order - 0.75 * beta)) * std::pow(before, beta);
  return std::clamp(factor, 0.2, 10.0);
}

/// The first step of x' = -rate x + slope from x0.
double first_of(double rate, double slope, double x0, SolverOptions options, double t0 = 0.0,
                double t_stop = infinite) {
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({x0}), .ode = [=](const At& at) { return -rate * at.x[0] + slope; }});
  });
  Machine machine(compile(leaf));
  machine.load(leaf.create_context(t0));
  Eigen::VectorXd scratch(1);
  const double f = -rate * x0 + slope;
  double f1 = 0.0;
  return first_step(machine, t0, vec({x0}), &f, scratch, &f1, options, 5.0, t_stop);
}

}  // namespace

TEST_CASE("the next step is that of the proportional-integral formula", "[step_size]") {
  for (const auto& [order, beta] : {std::pair{5.0, 0.04}, {8.0, 0.0}}) {
    StepController controller(order, beta);
    double before = 1e-4;  // no error was seen yet
    for (const double error : {0.5, 0.02, 0.9, 1e-3, 1.0, 1e-6, 0.3}) {
      INFO("order " << order << ", error " << error << " after " << before);
      CHECK_THAT(controller.accept(error, 2.0, false),
                 WithinRel(2.0 * proportional_integral(order, beta, error, before), 1e-12));
      before = std::max(error, 1e-4);
    }
  }
}

TEST_CASE("a smaller error makes the next step longer", "[step_size]") {
  double last = 0.0;
  for (const double error : {1.0, 0.3, 0.1, 0.01, 1e-3}) {
    const double next = StepController(5.0).accept(error, 1.0, false);
    CHECK(next > last);
    last = next;
  }
  CHECK(StepController(5.0).accept(1.0, 1.0, false) < 1.0);  // just accepted: be careful
}

TEST_CASE("a step grows by ten and shrinks to a fifth at most, and never grows after a rejection",
          "[step_size]") {
  CHECK(StepController(5.0).accept(1e-300, 1.0, false) == 10.0);
  CHECK(StepController(5.0).accept(0.0, 1.0, false) == 10.0);
  CHECK(StepController(5.0).accept(1e9, 1.0, false) == 0.2);
  CHECK(StepController(5.0, 0.04, 0.5, 3.0).accept(1e-300, 1.0, false) == 3.0);
  CHECK(StepController(5.0).accept(1e-300, 1.0, true) == 1.0);
  CHECK(StepController(5.0).accept(1.0, 1.0, true) < 1.0);
}

TEST_CASE("a rejected step shrinks by the order of the method, within bounds", "[step_size]") {
  const StepController controller(5.0);
  CHECK_THAT(controller.reject(32.0, 1.0), WithinRel(0.9 / 2.0, 1e-14));
  CHECK_THAT(controller.reject(1e5, 3.0), WithinRel(3.0 * 0.9 / 10.0, 1e-14));
  CHECK(controller.reject(1.0000001, 1.0) <= 0.9);
  CHECK(controller.reject(1e300, 1.0) == 1e-3);
  CHECK(controller.reject(infinite, 1.0) == 0.1);
  CHECK(controller.reject(not_a_number, 1.0) == 0.1);
}

TEST_CASE("the first step of a decay has a hundredth of the tolerance for its error",
          "[step_size]") {
  // In units of the tolerance x, f and f' are 1 / (rtol + atol): h^5 times that is 1/100.
  const SolverOptions options{.rtol = 1e-6, .atol = 1e-8};
  const double expected = std::pow(0.01 * (1e-6 + 1e-8), 0.2);
  CHECK_THAT(first_of(1.0, 0.0, 1.0, options), WithinRel(expected, 1e-6));
  CHECK_THAT(first_of(1e6, 0.0, 1.0, options), WithinRel(1e-6 * expected, 1e-6));  // another unit
}

TEST_CASE("the first step keeps to its bounds", "[step_size]") {
  const SolverOptions options{.rtol = 1e-6, .atol = 1e-8};
  CHECK(first_of(1.0, 0.0, 1.0, options, 0.0, 1e-3) == 1e-3);  // the next event
  CHECK(first_of(1.0, 0.0, 1.0, {.rtol = 1e-6, .atol = 1e-8, .max_step = 2e-3}) == 2e-3);
  CHECK(first_of(0.0, 0.0, 1.0, options, 0.0, 50.0) <= 50.0);  // nothing moves
  CHECK(first_of(0.0, 0.0, 1.0, options, 0.0, 50.0) > 0.01);
  // 100 roundings of the time: a shorter one would be lost in it.
  CHECK(first_of(1e15, 0.0, 1.0, options, 1e6) == 100.0 * eps * 1e6);
}

TEST_CASE("states that rest have a first step of a tenth of the run", "[step_size]") {
  // A state at zero with a constant slope: only atol measures it, and nothing bends its path. If it
  // rests, the step is a hundred trial steps of a thousandth of the run; otherwise it is the run.
  const SolverOptions options{.rtol = 1e-6, .atol = 1e-8};
  const double run = 50.0, tolerance = 1e-8;
  CHECK_THAT(first_of(0.0, 0.9e-5 * tolerance / run, 0.0, options, 0.0, run),
             WithinRel(0.1 * run, 1e-12));
  CHECK(first_of(0.0, 1.1e-5 * tolerance / run, 0.0, options, 0.0, run) == run);
}

TEST_CASE("an error too small for a logarithm has the factor of the formula", "[step_size]") {
  // The worst case: the step before had no error at all. 1e-9 and 1e-8 are beyond the longest
  // factor of each method, so the shortcut below 1e-9 changes no step.
  for (const double error : {1.01e-9, 1e-8}) {
    CHECK(StepController(5.0).accept(error, 1.0, false) == 10.0);
    CHECK(StepController(8.0, 0.0, 1.0 / 3.0, 6.0).accept(error, 1.0, false) == 6.0);
  }
  CHECK_THAT(StepController(5.0).accept(9e-8, 1.0, false),  // not beyond it any more
             WithinRel(proportional_integral(5.0, 0.04, 9e-8, 1e-4), 1e-12));
}

namespace {

/// x' = 0, but not a number after `end` [s].
Leaf ends_at(double end) {
  return Leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [=](const At& at) {
                                  return at.time > end ? not_a_number : 0.0;
                                }});
  });
}

bool finite_near(double end, double t, double h) {
  const Leaf leaf = ends_at(end);
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  const double x = 1.0;
  try {
    require_finite_near(machine, t, h, &x);
  } catch (const SimulationError&) {
    return false;
  }
  return true;
}

/// The message about a step of h with min_minor_step_size = 0.1 s.
std::string too_small(double h) {
  const Leaf leaf = ends_at(infinite);
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  const double x = 1.0;
  try {
    throw_step_too_small(machine, 0.0, h, &x, {.min_step = 0.1});
  } catch (const SimulationError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a derivative that ends within 16 steps or 64 roundings ahead is found", "[step_size]") {
  CHECK_FALSE(finite_near(0.015, 0.0, 1e-3));
  CHECK(finite_near(0.017, 0.0, 1e-3));
  const double rounding = eps * 1024.0;  // exact, as are the sums below
  CHECK_FALSE(finite_near(1024.0 + 60.0 * rounding, 1024.0, 0.0));
  CHECK(finite_near(1024.0 + 68.0 * rounding, 1024.0, 0.0));
}

TEST_CASE("a step of the least length names that option, a shorter scale does not", "[step_size]") {
  CHECK(too_small(0.1005).find("below min_minor_step_size = 0.1 s") != std::string::npos);
  CHECK(too_small(0.102).find("underflows") != std::string::npos);
}
