// A quantity that rests until a term turns on: no method steps over the change, however long its
// steps have grown. The equation x' = r s (1 - x), with s = 1 / (1 + exp(-k (t - 5))) and x(0) = 1/2,
// has the solution x = 1 - (1 + exp(k (t - 5)))^(-r / k) / 2. It neglects exp(-5 k), which s(0) is.
#include <cmath>

#include "support/draw.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr Method every_method[] = {Method::dopri5, Method::dop853, Method::radau,
                                   Method::bdf,    Method::adams,  Method::automatic};

struct TurnedOn {
  double r, k, end;  // [1/s], [1/s], [s]

  double at_end() const {
    const double late = k * (end - 5.0);
    return 1.0 - 0.5 * std::exp(-r / k * (late + std::log1p(std::exp(-late))));
  }
};

/// x, and with `stiffness` [1/s] above 0 a state that is at rest soon, so that `auto` takes radau.
Leaf rest(const TurnedOn& of, double stiffness) {
  return Leaf("rest", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.5, 0.0}), .ode = [=](const At& at, VectorRef rate) {
           rate[0] = of.r / (1.0 + std::exp(-of.k * (at.time - 5.0))) * (1.0 - at.x[0]);
           rate[1] = -stiffness * (at.x[1] - 1.0);
         }});
  });
}

}  // namespace

TEST_CASE("a term that turns on within a long step is seen, by every method", "[laws]") {
  Draw draw(5);
  for (int i = 0; i < 20; ++i) {
    const TurnedOn of{draw(1.0, 10.0), draw(10.0, 60.0), draw(5.5, 20.0)};
    for (const double stiffness : {0.0, 1e5}) {
      const Leaf leaf = rest(of, stiffness);
      for (const Method method : every_method) {
        const bool stiff_too =
            method == Method::automatic || method == Method::bdf || method == Method::radau;
        if (stiffness > 0.0 && !stiff_too) continue;
        for (const double rtol : {1e-3, 1e-6, 1e-9}) {
          INFO(to_string(method) << ", r " << of.r << ", k " << of.k << ", to " << of.end
                                 << " s, beside " << stiffness << " / s, rtol " << rtol);
          const Results results =
              simulate(leaf, leaf.create_context(), {0.0, of.end},
                       {.rtol = rtol, .atol = 0.01 * rtol, .ode_solver_method = method});
          const double error = results.context.continuous_state()[0] - of.at_end();
          INFO(error / rtol << " tolerances");
          // The flow contracts: the errors of the steps do not grow. Fifty of them may add up.
          CHECK(std::abs(error) < 50.0 * rtol);
        }
      }
    }
  }
}

// The same, turned off again at 13 s, long before the end at 20 s: the rates at both ends of a step are
// nothing, but not those of its stages. (adams looks at the ends of its steps only, and misses it.)
TEST_CASE("a term that is on in the middle of a long step is seen", "[laws]") {
  for (const double k : {5.0, 20.0}) {
    for (const double r : {1.0, 5.0, 50.0}) {
      const Leaf leaf("rest", [=](Leaf& l) {
        l.declare_continuous_state(
            {.initial = vec({0.5}), .ode = [=](const At& at, VectorRef rate) {
               const double on = 1.0 / (1.0 + std::exp(-k * (at.time - 5.0)));
               const double off = 1.0 / (1.0 + std::exp(k * (at.time - 13.5)));
               rate[0] = r * on * off * (1.0 - at.x[0]);
             }});
      });
      for (const Method method : every_method) {
        if (method == Method::adams) continue;
        for (const double rtol : {1e-4, 1e-6, 1e-9}) {
          INFO(to_string(method) << ", r " << r << ", k " << k << ", rtol " << rtol);
          const Results results =
              simulate(leaf, leaf.create_context(), {0.0, 20.0},
                       {.rtol = rtol, .atol = 0.01 * rtol, .ode_solver_method = method});
          const double x = results.context.continuous_state()[0];
          // On for 8.5 s. What is missed leaves 0.5; how exact a step is, is tested above.
          CHECK(std::abs(x - (1.0 - 0.5 * std::exp(-8.5 * r))) < 0.01);
        }
      }
    }
  }
}
