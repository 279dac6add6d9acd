// Declared derivatives: exact where functions are called, and differences of one function alone.
#include <saltus/model/equations.hpp>
#include <saltus/simulation/check_derivatives.hpp>
#include <saltus/simulation/linearize.hpp>

#include <cmath>
#include <limits>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

/// Which derivatives a leaf declares.
enum class Declares { nothing, jacobian, all };

/// x' = -k x^2, falls to `floor` and jumps to gain * x + 2: all functions are opaque. If they are
/// strict, they throw at other parameters, so that there are no differences by them.
std::shared_ptr<Leaf> decay(Declares declares, bool strict = false) {
  return make_leaf("decay", [declares, strict](Leaf& l) {
    for (const auto& [name, value] : {std::pair("k", 0.5), {"floor", 0.7}, {"gain", 0.25}})
      l.declare_dynamic_parameter(name, value);
    const auto look_at = [strict](const At& at) {
      if (strict && at.p != Eigen::Vector3d(0.5, 0.7, 0.25)) throw Error("other parameters");
    };
    ContinuousState state{.initial = vec({1.0}), .ode = [look_at](const At& at) {
                            look_at(at);
                            return -at.p[0] * at.x[0] * at.x[0];
                          }};
    if (declares == Declares::jacobian)
      state.jacobian = [](const At& at, MatrixRef out) { out(0, 0) = -2.0 * at.p[0] * at.x[0]; };
    if (declares == Declares::all)
      state.derivatives = [](const At& at, Derivatives& d) {
        d.by_continuous_state()(0, 0) = -2.0 * at.p[0] * at.x[0];
        d.by_parameters()(0, 0) = -at.x[0] * at.x[0];
      };
    l.declare_continuous_state(state);
    l.declare_continuous_state_output("x");
    ZeroCrossing floor{.name = "floor",
                       .guard = [look_at](const At& at) { return look_at(at), at.x[0] - at.p[1]; },
                       .reset_map =
                           [look_at](const At& at, Next& next) {
                             look_at(at);
                             next.set_continuous_state({at.p[2] * at.x[0] + 2.0});
                           },
                       .direction = Direction::positive_then_non_positive};
    if (declares == Declares::all) {
      floor.guard_derivatives = [](const At&, Derivatives& d) {
        d.by_continuous_state()(0, 0) = 1.0, d.by_parameters()(0, 1) = -1.0;
      };
      floor.reset_derivatives = [](const At& at, Derivatives& d) {
        d.by_continuous_state()(0, 0) = at.p[2], d.by_parameters()(0, 2) = at.x[0];
      };
    }
    l.declare_zero_crossing(floor);
  });
}

const std::vector<std::string> by = {"k", "floor", "gain", "x[0]"};

Results run(const Leaf& leaf, std::vector<std::string> names = by) {
  return simulate(leaf, leaf.create_context(), {0.0, 1.5},
                  {.rtol = 1e-11, .atol = 1e-13, .sensitivity = std::move(names)});
}

/// x(t) = x0 / (1 + k x0 t) to x = c at tau = (1/c - 1/x0) / k, then from r = a c + 2 for t - tau.
std::vector<double> exact(double t) {
  const double k = 0.5, c = 0.7, a = 0.25, x0 = 1.0;
  const double tau = (1.0 / c - 1.0 / x0) / k, r = a * c + 2.0, s = t - tau;
  const double x = r / (1.0 + k * r * s), by_r = x * x / (r * r), rate = -k * x * x;
  return {-x * x * s + rate * (tau / k), by_r * a - rate * (-1.0 / (c * c * k)), by_r * c,
          -rate * (1.0 / (x0 * x0 * k))};
}

}  // namespace

TEST_CASE("declared derivatives make a run of opaque functions exact", "[sensitivity][declared]") {
  const Results found = run(*decay(Declares::all, true));
  REQUIRE(found.events.size() == 1);
  const std::vector<double> expected = exact(1.5);
  for (std::size_t k = 0; k < by.size(); ++k) {
    INFO(by[k]);
    CHECK_THAT(found.sensitivities.continuous_state[k], WithinAbs(expected[k], 1e-8));
  }
  CHECK(found.sensitivities.gaps.empty());
  const Results without = run(*decay(Declares::nothing, true));
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::isnan(without.sensitivities.continuous_state[k]));
}

TEST_CASE("differences of opaque functions agree with declared derivatives",
          "[sensitivity][declared]") {
  const auto declares = GENERATE(Declares::nothing, Declares::jacobian, Declares::all);
  const Results found = run(*decay(declares));
  const std::vector<double> expected = exact(1.5);
  for (std::size_t k = 0; k < by.size(); ++k)
    CHECK_THAT(found.sensitivities.continuous_state[k], WithinAbs(expected[k], 1e-8));
}

TEST_CASE("a description says which derivatives are declared", "[sensitivity][declared]") {
  const auto words = [](Declares declares) {
    const auto leaf = decay(declares);
    return Simulator(*leaf, {.sensitivity = {"k"}}).describe();
  };
  CHECK_THAT(words(Declares::nothing),
             Contains("central differences of the derivative of block 'decay'\n"));
  CHECK_THAT(words(Declares::jacobian), Contains("(but for its Jacobian)"));
  CHECK_THAT(words(Declares::all),
             Contains("declared derivatives of the derivative of block 'decay'"));
  CHECK_THAT(words(Declares::all), !Contains("differences"));
}

TEST_CASE("linearize takes declared derivatives", "[linearize][declared]") {
  const auto all = decay(Declares::all, true), jacobian = decay(Declares::jacobian);
  const Linearization exact_one = linearize(*all, all->create_context());
  CHECK(exact_one.A(0, 0) == -1.0);
  CHECK(exact_one.method() == "exact");
  const Linearization by_jacobian = linearize(*jacobian, jacobian->create_context());
  CHECK(by_jacobian.A(0, 0) == -1.0);
  CHECK(by_jacobian.method() == "exact");
}

TEST_CASE("check_derivatives finds those that are wrong", "[declared]") {
  const auto right = decay(Declares::all), jacobian = decay(Declares::jacobian);
  CHECK(check_derivatives(*right, right->create_context()).empty());
  CHECK(check_derivatives(*jacobian, jacobian->create_context()).empty());
  const auto wrong = make_leaf("wrong", [](Leaf& l) {
    l.declare_dynamic_parameter("k", 2.0);
    l.declare_continuous_state({.initial = vec({3.0}),
                                .ode = [](const At& at) { return -at.p[0] * at.x[0] + at.time; },
                                .derivatives =
                                    [](const At& at, Derivatives& d) {
                                      d.by_continuous_state()(0, 0) = -at.p[0];
                                      d.by_parameters()(0, 0) = at.x[0];
                                    }});
  });
  const auto found = check_derivatives(*wrong, wrong->create_context());
  REQUIRE(found.size() == 2);
  CHECK(found[0].by == "k");
  CHECK(found[0].declared == 3.0);
  CHECK_THAT(found[0].difference, WithinAbs(-3.0, 1e-9));
  CHECK(found[1].by == "time");
}

TEST_CASE("declared derivatives that are not finite are an error", "[declared][errors]") {
  const auto leaf = make_leaf("broken", [](Leaf& l) {
    l.declare_dynamic_parameter("k", 2.0);
    l.declare_continuous_state({.initial = vec({1.0}),
                                .ode = [](const At& at) { return -at.p[0] * at.x[0]; },
                                .derivatives =
                                    [](const At& at, Derivatives& d) {
                                      d.by_continuous_state()(0, 0) = -at.p[0];
                                      d.by_parameters()(0, 0) =
                                          at.time < 0.5 ? -at.x[0] : std::nan("");
                                    }});
  });
  const auto go = [&] {
    simulate(*leaf, leaf->create_context(), {0.0, 1.0}, {.sensitivity = {"k"}});
  };
  CHECK_THROWS_WITH(go(),
                    Contains("block 'broken'") && Contains("in row 0, by k") && Contains("t = "));
  CHECK_THROWS_AS(go(), SimulationError);
}

TEST_CASE("a function with a formula is exact beside one that is called",
          "[sensitivity][declared]") {
  // The formula oscillates so fast that differences with shifts from 1e-3 to 1e-9 find no derivative.
  DiagramBuilder builder;
  const auto fast = make_leaf("fast", [](Leaf& l) {
    const ParameterIndex w = l.declare_dynamic_parameter("w", 3e9);
    l.declare_continuous_state(1, equations<1>([w](const auto& at, auto& xdot) {
                                 using std::sin;
                                 xdot[0] = sin(at.p(w));
                               }));
    l.declare_continuous_state_output("x");
  });
  const auto slow = make_leaf("slow", [](Leaf& l) {
    l.declare_input_port({.shape = Shape::scalar()});
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return at.u(0) - at.x[0]; }});
  });
  builder.add(fast), builder.add(slow);
  builder.connect(fast->output(0), slow->input(0));
  const Diagram diagram = builder.build();
  const Results found = simulate(diagram, diagram.create_context(), {0.0, 1.0},
                                 {.rtol = 1e-10, .atol = 1e-12, .sensitivity = {"fast.w"}});
  // x = sin(w) t, and y' = x - y, so that dy/dw = cos(w) (t - 1 + exp(-t)).
  CHECK_THAT(found.sensitivities.continuous_state[0], WithinAbs(std::cos(3e9), 1e-9));
  CHECK_THAT(found.sensitivities.continuous_state[1],
             WithinAbs(std::cos(3e9) * std::exp(-1.0), 1e-8));
}
