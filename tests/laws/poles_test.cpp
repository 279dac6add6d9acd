// A pole of a derivative in time: no step passes it, at any tolerance and by any method. What only
// looks like a pole is passed.
#include <cmath>

#include "saltus/model/equations.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

using std::cbrt, std::cos, std::sin, std::tan;

template <int N, class F>
Leaf leaf_of(Eigen::VectorXd start, F f) {
  return Leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = start, .ode = equations<N>(f)});
  });
}

Results run(const Leaf& leaf, Method method, double rtol, double begin = 0.0) {
  return simulate(
      leaf, leaf.create_context(begin), {begin, 1.0},
      {.rtol = rtol, .atol = 0.01 * rtol, .ode_solver_method = method, .throw_errors = false});
}

}  // namespace

TEST_CASE("a run ends before the pole of its derivative, by every method", "[laws][poles]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-2, 1e-3, 1e-4, 1e-6);
  const auto fails = [&](const char* name, const Leaf& leaf, double pole) {
    const auto results = run(leaf, method, rtol);
    INFO(name << " at " << pole << ", " << method << ", rtol " << rtol << ": "
              << to_string(results.status) << " at " << results.context.time() << ", "
              << results.message);
    CHECK(results.status == Status::failed);
    CHECK(results.context.time() <= pole + 100.0 * eps);  // a few roundings of the pole itself
  };
  for (int i = 0; i < 8; ++i) {
    const double c = 0.2 + 0.0871 * i;
    fails("1/(c - t)",
          leaf_of<1>(vec({1.0}), [c](const auto& at, auto& f) { f[0] = 1.0 / (c - at.time()); }),
          c);
    fails("-1/(c - t)^3",
          leaf_of<1>(vec({1.0}),
                     [c](const auto& at, auto& f) {
                       const auto d = c - at.time();
                       f[0] = -1.0 / (d * d * d);
                     }),
          c);
    fails("tan",
          leaf_of<1>(vec({1.0}), [c](const auto& at,
                                     auto& f) { f[0] = tan(at.time() * (std::acos(0.0) / c)); }),
          c);
  }
}

TEST_CASE("a divisor that crosses zero without a pole is passed", "[laws][poles]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-2, 1e-4);
  const auto passes = [&](const char* name, const Leaf& leaf, double expected) {
    const auto results = run(leaf, method, rtol, -0.917);
    INFO(name << ", " << method << ", rtol " << rtol << ": " << results.message);
    CHECK(results.status == Status::reached_end);
    // The derivative has a kink or a peak; one step across it costs some tens of tolerances.
    CHECK(results.context.continuous_state()[0] == Approx(expected).margin(100.0 * rtol));
  };
  // Si(1) + Si(0.917), by the series of the sine integral.
  const auto si = [](double x) {
    double sum = 0.0, term = x;
    for (int k = 0; k < 12; ++k, term *= -x * x / (2.0 * k * (2.0 * k + 1.0)))
      sum += term / (2.0 * k + 1.0);
    return sum;
  };
  passes("sin(t)/t",
         leaf_of<1>(vec({0.0}), [](const auto& at, auto& f) { f[0] = sin(at.time()) / at.time(); }),
         si(1.0) + si(0.917));
  // An integrable singularity. `taylor` refuses nothing here, and its steps end before it.
  const double area = 1.5 * (1.0 - std::pow(0.917, 2.0 / 3.0));
  passes("0.01/cbrt(t)",
         leaf_of<1>(vec({0.0}), [](const auto& at, auto& f) { f[0] = 0.01 / cbrt(at.time()); }),
         0.01 * area);
}

TEST_CASE("a bounded derivative is no pole, however short the steps and however late the time",
          "[laws][poles]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-2, 1e-3, 1e-4);
  const double begin = GENERATE(0.0, 1e4, 1.7e9);
  const auto end_of = [&](const Leaf& leaf, std::initializer_list<double> stops) {
    Simulator simulator(leaf, {.rtol = rtol, .ode_solver_method = method, .throw_errors = false});
    simulator.initialize(leaf.create_context(begin));
    for (const double stop : stops)
      if (simulator.advance_to(begin + stop) == Status::failed) break;
    INFO(method << ", rtol " << rtol << ", from " << begin << ": " << simulator.results().message);
    CHECK(!contains(simulator.results().message, "pole"));
    return simulator.context().continuous_state()[0];
  };
  // Si(2) + Si(1) = 2.5514960, with the resolution of the time as an error of its argument.
  const double resolution = 1e-15 * begin;
  CHECK(end_of(leaf_of<1>(vec({0.0}),
                          [=](const auto& at, auto& f) {
                            const auto s = at.time() - (begin + 1.0);
                            f[0] = sin(s) / s;
                          }),
               {1.0 - 1e-6, 1.0 + 1e-6, 3.0}) ==
        Approx(2.5514960).margin(100.0 * rtol + 10.0 * resolution));
  // A quotient of two states that vanish together: sin(2 t) / sin(t), from t = 1. At 1e-2 bdf has
  // no digit of them left.
  if (rtol < 1e-2)
    end_of(leaf_of<5>(vec({std::sin(1.0), std::cos(1.0), std::sin(2.0), std::cos(2.0), 0.0}),
                      [](const auto& at, auto& f) {
                        f[0] = at.x(1), f[1] = -at.x(0), f[2] = 2.0 * at.x(3),
                        f[3] = -2.0 * at.x(2);
                        f[4] = at.x(2) / at.x(0);
                      }),
           {4.0});
  // The share of a substance of which nothing is left.
  end_of(leaf_of<3>(vec({1.0, 1.0, 0.0}),
                    [](const auto& at, auto& f) {
                      f[0] = -300.0 * at.x(0), f[1] = -500.0 * at.x(1);
                      f[2] = at.x(0) / (at.x(0) + at.x(1)) - at.x(2);
                    }),
         {20.0});
}

TEST_CASE("what a run divides by is looked at only where a step may pass its zero",
          "[laws][poles]") {
  int calls = 0;  // each look near a zero evaluates the derivative
  const auto count = [&](double rtol) {
    const Leaf leaf =
        leaf_of<1>(vec({0.0}), [](const auto& at, auto& f) { f[0] = sin(at.time()) / at.time(); });
    const auto results = run(leaf, Method::dopri5, rtol, -0.917);
    calls = static_cast<int>(results.statistics.right_hand_side_calls);
    return calls - 6 * static_cast<int>(results.statistics.steps + results.statistics.rejected);
  };
  CHECK(count(1e-4) > count(1e-6));
}
