// The Taylor method: tolerances, orders, looks at guards, what it refuses.
#include <numbers>

#include "saltus/solver/detail/taylor.hpp"
#include "saltus/solver/detail/taylor/step_rule.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x'' = -x from (1, 0): x = cos t.
Leaf oscillator() {
  return Leaf("oscillator", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                       xdot[0] = at.x(1);
                                       xdot[1] = -at.x(0);
                                     })});
  });
}

constexpr double gravity = 9.8;

/// theta'' = -g sin(theta), released at rest.
Leaf pendulum(double angle) {
  return Leaf("pendulum", [angle](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({angle, 0.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                         using std::sin;
                                         xdot[0] = at.x(1);
                                         xdot[1] = -gravity * sin(at.x(0));
                                       })});
    l.declare_zero_crossing({.name = "turn", .formula = [](const auto& at) { return at.x(1); }});
    l.declare_zero_crossing(
        {.name = "slow", .formula = [](const auto& at) { return at.x(1) * at.x(1) - 1e-12; }});
  });
}

SimulatorOptions by_taylor(double rtol, double atol) {
  return {.rtol = rtol, .atol = atol, .ode_solver_method = Method::taylor};
}

Results run(const System& system, double end, const SimulatorOptions& options) {
  return simulate(system, system.create_context(), {0.0, end}, options);
}

/// The times of the events of this name.
std::vector<double> times(const Results& results, std::string_view name) {
  std::vector<double> found;
  for (std::size_t i = 0; i < results.events.size(); ++i)
    if (results.events[i].name == name) found.push_back(results.events[i].time);
  return found;
}

}  // namespace

TEST_CASE("the order grows with the tolerance as 1 - ln(rtol) / 2", "[taylor]") {
  CHECK(taylor::order_of(1e-4) == 6);
  CHECK(taylor::order_of(1e-6) == 8);
  CHECK(taylor::order_of(1e-8) == 11);
  CHECK(taylor::order_of(1e-10) == 13);
  CHECK(taylor::order_of(1e-12) == 15);
  CHECK(taylor::order_of(0.0) == 20);  // as at the rounding
  CHECK(taylor::order_of(0.5) == taylor::least_order);
}

TEST_CASE("a step ends where one of the last two terms is a tolerance", "[taylor]") {
  // terms of exp(t) at order 8 with a tolerance of 1e-6
  const auto term = [](int k) { return 1e6 / std::tgamma(k + 1.0); };
  const double h = taylor::length_of(8, term);
  CHECK(h == std::min(std::pow(term(8), -1.0 / 8), std::pow(term(7), -1.0 / 7)));
  // every second term vanishes
  const auto odd = [&](int k) { return k % 2 == 1 ? term(k) : 0.0; };
  CHECK(taylor::length_of(8, odd) == std::pow(term(7), -1.0 / 7));
  // a polynomial of degree 2 is the solution
  CHECK(taylor::length_of(8, [](int k) { return k > 2 ? 0.0 : 1e6; }) == infinite);
  // one of degree 6 is bounded by its last terms, and the check of the step confirms it
  CHECK(taylor::length_of(8, [](int k) { return k > 6 ? 0.0 : 1e6; }) < 1.0);
}

TEST_CASE("a step that failed is followed by a shorter one, by its error", "[taylor]") {
  const int p = GENERATE(4, 15, 30);
  using taylor::shorter;
  CHECK(shorter(1.0 + 1e-9, p) < 0.99);  // just too long
  CHECK(shorter(1.0 + 1e-9, p) > 0.5);
  // The error is of order p + 1: the step that has the right one, and a margin.
  const double error = std::pow(2.0, p + 1);
  CHECK(shorter(error, p) < 0.5);
  CHECK(shorter(error, p) > 0.25);
  for (const double none : {infinite, std::nan(""), 1e300}) {
    CHECK(shorter(none, p) < 0.25);  // it says nothing of the length
    CHECK(shorter(none, p) > 0.01);
  }
}

TEST_CASE("Taylor is within some tolerances of the closed form at each of them", "[taylor]") {
  const Leaf leaf = oscillator();
  for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    const Results results = run(leaf, 20.0, by_taylor(rtol, rtol));
    const Eigen::VectorXd x = results.context.continuous_state();
    const double error = std::hypot(x[0] - std::cos(20.0), x[1] + std::sin(20.0));
    // A step leaves out a term of about exp(-2) of a tolerance and its successors. A step is above
    // (p!)^(1/p) rtol^(1/p) > 0.4 s long, so there are at most 50 of them, and nothing grows.
    INFO(rtol);
    CHECK(error < 50.0 * rtol);
    CHECK(results.statistics.steps < 50);
  }
}

TEST_CASE("in a long run the error grows with the terms left out, not with the rounding",
          "[taylor]") {
  const Leaf leaf = oscillator();
  const double end = 2000.0 * std::numbers::pi;
  const Results results = run(leaf, end, by_taylor(1e-15, 1e-15));
  // each step leaves out about exp(-2) of a tolerance, all with one sign at worst
  const double bound = static_cast<double>(results.statistics.steps) * std::exp(-2.0) * 2e-15;
  CHECK(std::abs(results.context.continuous_state()[1] + std::sin(end)) < bound);
}

TEST_CASE("free flight is one step, because the polynomial is the solution", "[taylor]") {
  const Leaf leaf("stone", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({10.0, 3.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                        xdot[0] = at.x(1);
                                        xdot[1] = -9.81;
                                      })});
  });
  const Results results = run(leaf, 7.0, by_taylor(1e-9, 1e-9));
  CHECK(results.statistics.steps == 1);
  const double exact = 10.0 + 3.0 * 7.0 - 0.5 * 9.81 * 49.0;
  CHECK(std::abs(results.context.continuous_state()[0] - exact) < 4.0 * eps * 240.0);
}

TEST_CASE("no turn of a pendulum is missed, nor a pair of crossings beside it", "[taylor]") {
  const Leaf leaf = pendulum(0.05);
  constexpr double half_period = 1.0037017879400650;  // 2 K(sin(0.025)) / sqrt(g)
  const Results results = run(leaf, 20.5, by_taylor(1e-13, 1e-13));
  const auto turns = times(results, "turn"), slow = times(results, "slow");
  // At t = 0 the pendulum is at rest: no crossing of its speed. v^2 = 1e-12 at 1e-6 / (g sin 0.05)
  // s before and after each turn, and after the start.
  const double apart = 1e-6 / (gravity * std::sin(0.05));
  REQUIRE(turns.size() == 20);
  REQUIRE(slow.size() == 41);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const double exact = half_period * static_cast<double>(i + 1);
    CHECK(std::abs(turns[i] - exact) < 1e-11);
    CHECK(std::abs(slow[2 * i + 1] - (exact - apart)) < 1e-10);
    CHECK(std::abs(slow[2 * i + 2] - (exact + apart)) < 1e-10);
  }
}

TEST_CASE("a pair of crossings within a step is seen however long the step is", "[taylor]") {
  // x'' = 0: the step has no bound. The guard (t - 3)^2 - d^2 dips below zero for 2 d seconds.
  for (const double d : {0.3, 1e-2, 1e-4, 1e-5}) {
    const Leaf leaf("dip", [d](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({0.0}),
           .ode = equations<1>([](const auto&, auto& xdot) { xdot[0] = 1.0; })});
      l.declare_zero_crossing({.name = "dip", .formula = [d](const auto& at) {
                                 const auto s = at.x(0) - 3.0;
                                 return s * s - d * d;
                               }});
    });
    const Results results = run(leaf, 10.0, by_taylor(1e-9, 1e-9));
    INFO(d);
    const auto found = times(results, "dip");
    REQUIRE(found.size() == 2);
    // the root moves by the rounding of 9 over the slope 2 d
    CHECK(std::abs(found[0] - (3.0 - d)) < 10.0 * eps * 9.0 / d);
    CHECK(std::abs(found[1] - (3.0 + d)) < 10.0 * eps * 9.0 / d);
  }
}

TEST_CASE("a monitor changes no bit of a run by taylor", "[taylor]") {
  const auto rows = [](bool watched) {
    const Leaf leaf("pendulum", [watched](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({2.0, 0.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                         using std::sin;
                                         xdot[0] = at.x(1);
                                         xdot[1] = -gravity * sin(at.x(0));
                                       })});
      if (watched)
        l.declare_zero_crossing(
            {.name = "upright", .formula = [](const auto& at) { return at.x(0) - 1.9; }});
    });
    return run(leaf, 30.0, by_taylor(1e-10, 1e-10)).context.continuous_state();
  };
  CHECK(rows(true) == rows(false));
}

TEST_CASE("a solution that has no series at its start begins with dop853", "[taylor]") {
  // x' = sqrt(x + t^2) from 0: sqrt has no series at 0
  const Leaf leaf("root", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = equations<1>([](const auto& at, auto& xdot) {
                                  using std::sqrt;
                                  xdot[0] = sqrt(at.time() * at.time() + at.x(0));
                                })});
  });
  const auto end = [&](Method method) {
    SimulatorOptions options = by_taylor(1e-10, 1e-10);
    options.ode_solver_method = method;
    return run(leaf, 2.0, options).context.continuous_state()[0];
  };
  CHECK(std::abs(end(Method::taylor) - end(Method::dop853)) < 1e-7);
}

TEST_CASE("a solution that blows up ends with an error that says where", "[taylor]") {
  const Leaf leaf("blow", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}),
         .ode = equations<1>([](const auto& at, auto& xdot) { xdot[0] = at.x(0) * at.x(0); })});
  });
  const std::string said = message<SimulationError>([&] { run(leaf, 2.0, by_taylor(1e-9, 1e-9)); });
  CHECK(contains(said, "t = 1"));
  CHECK(contains(said, "blow"));
}

TEST_CASE("a pulse that the series at the start does not show is not passed over", "[taylor]") {
  // x' = exp(-100 (t - 13)^2): zero within the rounding at t = 0 and at the end, as are its
  // derivatives. The integral is sqrt(pi) / 10.
  const Leaf leaf("pulse", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = equations<1>([](const auto& at, auto& xdot) {
                                  using std::exp;
                                  const auto s = 10.0 * (at.time() - 13.0);
                                  xdot[0] = exp(-(s * s));
                                })});
  });
  for (const double rtol : {1e-6, 1e-9, 1e-12}) {
    const Results results = run(leaf, 20.0, by_taylor(rtol, rtol));
    INFO(rtol);
    // at most some ten tolerances, as on the shelf
    CHECK(std::abs(results.context.continuous_state()[0] - 0.1 * std::sqrt(std::numbers::pi)) <
          10.0 * rtol);
  }
}

TEST_CASE("windows of other kinds are not passed over either", "[taylor]") {
  const auto end = [](auto rate, double until) {
    const Leaf leaf("window", [&](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({0.0}),
           .ode = equations<1>([rate](const auto& at, auto& xdot) { xdot[0] = rate(at.time()); })});
    });
    return run(leaf, until, by_taylor(1e-8, 1e-8)).context.continuous_state()[0];
  };
  const double between = end(
      [](const auto& t) {
        using std::tanh;
        return tanh(5.0 * (t - 10.0)) - tanh(5.0 * (t - 14.0));
      },
      20.0);
  CHECK(std::abs(between - 8.0) < 1e-7);  // 2 from 10 s to 14 s, up to exp(-40)
  const double power = end(
      [](const auto& t) {
        const auto w = 4.0 * t * (1.0 - t), w2 = w * w, w4 = w2 * w2, w8 = w4 * w4;
        return w8 * w8;
      },
      1.0);
  // the integral of (4 t (1 - t))^16: 4^16 B(17, 17)
  const double exact = std::exp(16.0 * std::log(4.0) + 2.0 * std::lgamma(17.0) - std::lgamma(34.0));
  CHECK(std::abs(power - exact) < 1e-7);
}

TEST_CASE("a guard that its series does not show is looked at as by other methods", "[taylor]") {
  // A stone thrown over a hill: its flight is one step, and the hill is flat at its start.
  const Leaf leaf("stone", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0, 3.0}), .ode = equations<3>([](const auto& at, auto& xdot) {
                                            xdot[0] = 8.0;
                                            xdot[1] = at.x(2);
                                            xdot[2] = -9.81;
                                          })});
    l.declare_zero_crossing({.name = "hill", .formula = [](const auto& at) {
                               using std::exp;
                               const auto s = (at.x(0) - 5.0) / 0.5;
                               return at.x(1) - 2.0 * exp(-(s * s));
                             }});
  });
  CHECK(times(run(leaf, 1.0, by_taylor(1e-9, 1e-9)), "hill").size() == 3);
}

TEST_CASE("crossings of functions of t^4 are seen, though most of their terms vanish", "[taylor]") {
  const Leaf leaf("clock", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}),
         .ode = equations<1>([](const auto&, auto& xdot) { xdot[0] = 1.0; })});
    l.declare_zero_crossing({.name = "turns", .formula = [](const auto& at) {
                               using std::cos;
                               const auto x2 = at.x(0) * at.x(0);
                               return cos(3.0 * x2 * x2) - 0.5;
                             }});
  });
  for (const double rtol : {1e-6, 1e-7, 1e-8, 1e-10})
    CHECK(times(run(leaf, 1.6, by_taylor(rtol, rtol)), "turns").size() == 6);
}

TEST_CASE("a crossing at the end of the run does not hide one before it", "[taylor]") {
  // (t - a)(t - T) is zero at the end T, where rounding decides its sign
  for (int i = 1; i <= 40; ++i) {
    const double end = 1.0 + 0.1 * i, a = 0.37 * end, k = 1.0 + 0.01 * i;
    const Leaf leaf("parabola", [&](Leaf& l) {
      l.declare_continuous_state({.initial = vec({k * a * end, -k * (a + end)}),
                                  .ode = equations<2>([k](const auto& at, auto& xdot) {
                                    xdot[0] = at.x(1);
                                    xdot[1] = 2.0 * k;
                                  })});
      l.declare_zero_crossing({.name = "zero",
                               .direction = Direction::positive_then_non_positive,
                               .formula = [](const auto& at) { return at.x(0); }});
    });
    const auto found = times(run(leaf, end, by_taylor(1e-9, 1e-9)), "zero");
    INFO(end);
    REQUIRE(found.size() >= 1);
    CHECK(std::abs(found[0] - a) < 1e-12 * end);
  }
}

TEST_CASE("the dense output has the order of the series", "[taylor]") {
  const Leaf leaf = oscillator();
  for (const double rtol : {1e-6, 1e-10, 1e-12, 1e-15}) {
    SimulatorOptions options = by_taylor(rtol, rtol);
    options.dense_output = true;
    const Results results = run(leaf, 20.0, options);
    double worst = 0.0;
    for (double t = 0.0; t <= 20.0; t += 0.01)
      worst = std::max(worst, std::abs(results.at(t).continuous_state[0] - std::cos(t)));
    INFO(rtol);
    CHECK(worst < 50.0 * std::max(rtol, 10.0 * eps));  // as at the end
  }
}

TEST_CASE("a least step that the tolerance does not allow ends the run with that reason",
          "[taylor]") {
  const Leaf leaf("fast", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                       xdot[0] = 30.0 * at.x(1);
                                       xdot[1] = -30.0 * at.x(0);
                                     })});
  });
  SimulatorOptions options = by_taylor(1e-9, 1e-9);
  options.min_minor_step_size = 1.0;
  const std::string said = message<SimulationError>([&] { run(leaf, 10.0, options); });
  CHECK(contains(said, "min_minor_step_size"));
}

TEST_CASE("equations for another number of states are refused", "[taylor]") {
  const std::string said = message<ModelError>([] {
    Leaf("three", [](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, 0.0, 0.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                              xdot[0] = at.x(1);
                                              xdot[1] = at.x(0);
                                            })});
    });
  });
  CHECK(contains(said, "written for 2 continuous states, the block has 3"));
  CHECK(contains(said, "equations<3>"));
}

TEST_CASE("exp and its relatives may hide a pulse; what is algebraic, or turns, may not",
          "[taylor]") {
  tape::Graph g;
  const tape::Node x = g.continuous_state(0), t = g.time();
  const tape::Node pulse =
      g.unary(tape::Op::exp, g.unary(tape::Op::neg, g.binary(tape::Op::mul, t, t)));
  const tape::Node sine = g.unary(tape::Op::sin, g.binary(tape::Op::div, x, t));
  CHECK(tape::may_hide(g, std::array{g.binary(tape::Op::add, sine, pulse)}));
  CHECK(tape::may_hide(g, std::array{sine, pulse}));
  CHECK_FALSE(tape::may_hide(g, std::array{sine, x}));  // the pulse is in the graph, not needed
  CHECK(tape::may_hide(g, std::array{g.binary(tape::Op::pow, x, g.constant(200.0))}));
  CHECK(tape::may_hide(g, std::array{g.binary(tape::Op::pow, x, t)}));
  CHECK_FALSE(tape::may_hide(g, std::array{g.binary(tape::Op::pow, x, g.constant(-1.5))}));
}

TEST_CASE("a derivative without a series is refused with the reason", "[taylor]") {
  const Leaf called("called", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at, VectorRef xdot) { xdot[0] = -at.x[0]; }});
  });
  const std::string of_called =
      message<ModelError>([&] { run(called, 1.0, by_taylor(1e-9, 1e-9)); });
  CHECK(contains(of_called, "the derivative of block 'called'"));
  CHECK(contains(of_called, "'taylor'"));
  CHECK(contains(of_called, "equations<N>"));
  const Leaf kinked("kinked", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = equations<1>([](const auto& at, auto& xdot) {
                                  using std::abs;
                                  xdot[0] = -abs(at.x(0) - 0.5);
                                })});
  });
  CHECK(contains(message<ModelError>([&] { run(kinked, 1.0, by_taylor(1e-9, 1e-9)); }), "'abs'"));
}
