// Tolerances of each state: the weights of all methods, their widths, the first step.
#include "saltus/solver/tolerance.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x_i' = -rate_i x_i from 1.
Leaf decays(const Eigen::VectorXd& rates) {
  return {"decays", [&](Leaf& leaf) {
            leaf.declare_continuous_state({.initial = Eigen::VectorXd::Ones(rates.size()),
                                           .ode = [rates](const At& at, VectorRef xdot) {
                                             xdot = -rates.cwiseProduct(at.x);
                                           }});
            leaf.declare_continuous_state_output("x");
          }};
}

Results run(const Leaf& leaf, SimulatorOptions options) {
  options.recorded_signals = {{"x", leaf.output(0)}};
  return simulate(leaf, leaf.create_context(), {0.0, 1.0}, options);
}

}  // namespace

TEST_CASE("a tolerance is one number, or one for each state", "[tolerance]") {
  const Tolerance one = 1e-6, each = {1e-6, 1e-9, 1e-3};
  CHECK_FALSE(one.by_state());
  CHECK(one[7] == 1e-6);
  CHECK(each.by_state());
  CHECK(each[1] == 1e-9);
  CHECK(each.smallest() == 1e-9);
  CHECK(double(one) == 1e-6);
  Tolerance scaled = each;
  scaled *= 2.0;
  CHECK(scaled.each() == std::vector{2e-6, 2e-9, 2e-3});
}

TEST_CASE("n equal tolerances are one, to the bit, by every method", "[tolerance]") {
  for (const Index n : {1, 2, 4}) {
    const Leaf leaf = decays(Eigen::VectorXd::LinSpaced(n, 1.0, 50.0));
    const auto size = static_cast<std::size_t>(n);
    for (const Method method : methods) {
      INFO(method << ", " << n);
      SimulatorOptions options{.rtol = 1e-7, .atol = 1e-9};
      options.ode_solver_method = method;
      const Results once = run(leaf, options);
      options.atol = std::vector<double>(size, 1e-9);
      const Results by_atol = run(leaf, options);
      options.rtol = std::vector<double>(size, 1e-7);
      const Results by_both = run(leaf, options);
      for (const Results* other : {&by_atol, &by_both}) {
        CHECK(other->time == once.time);
        CHECK(other->signals[0].values == once.signals[0].values);
      }
    }
  }
}

TEST_CASE("a wide tolerance of one state saves its steps, by every method", "[tolerance]") {
  const Leaf leaf = decays(vec({1.0, 200.0}));
  for (const Method method :
       {Method::dopri5, Method::dop853, Method::adams}) {  // stability bounds no step of bdf
    INFO(method);
    SimulatorOptions tight{.rtol = 1e-9, .atol = 1e-11};
    tight.ode_solver_method = method;
    SimulatorOptions wide = tight;
    wide.rtol = {1e-9, 1e-2}, wide.atol = {1e-11, 1e-2};
    const Results exact = run(leaf, tight), rough = run(leaf, wide);
    CHECK(rough.statistics.steps < exact.statistics.steps);
    // ten tolerances for a state that shrinks
    const double end = rough.signals[0].matrix()(rough.signals[0].matrix().rows() - 1, 0);
    CHECK_THAT(end, Catch::Matchers::WithinAbs(std::exp(-1.0), 10.0 * 2e-9));
  }
}

TEST_CASE("a width that is not that of the states is refused, with the blocks", "[tolerance]") {
  DiagramBuilder builder;
  builder.add<Leaf>("left", [](Leaf& l) { declare_ramp(l); });
  builder.add<Leaf>("right", [](Leaf& l) { declare_ramp(l); });
  const auto pair = builder.build("pair");
  const auto refused = [&](const SimulatorOptions& options) {
    return message<ModelError>([&] { Simulator(pair, options); });
  };
  CHECK(refused({.atol = {1e-6, 1e-6, 1e-6}}) ==
        "option atol: expected one number, or 2 numbers, one for each continuous state ('left' 1, "
        "'right' 1); found 3");
  CHECK(
      contains(refused({.rtol = std::vector<double>{}}), "option rtol: expected one number, or 2"));
  CHECK(refused({.rtol = {1e-6, 1e-3}, .atol = {1e-6, 1e-8}}) == "no exception");
  CHECK(refused({.atol = {1e-6, 0.0}}) ==
        "option atol: expected positive numbers, found [1e-06, 0]");
  CHECK(contains(refused({.rtol = {1e-6, 1e-16}}), "at least 1e-15"));
}

TEST_CASE("the first step is as long as the option says, by every method", "[tolerance]") {
  const Leaf leaf = decays(vec({1.0}));
  for (const Method method : methods) {
    INFO(method);
    SimulatorOptions options{.first_step = 1e-5};
    options.ode_solver_method = method;
    CHECK_THAT(run(leaf, options).time[1], Catch::Matchers::WithinRel(1e-5, 1e-9));
  }
  for (const double bad : {0.0, -1.0, infinite, not_a_number}) {
    CHECK(contains(message<ModelError>([&] { run(leaf, {.first_step = bad}); }),
                   "option first_step: expected a time > 0 s, or none, found"));
  }
}
