// A run that begins with a step of any length: no step is taken because an error estimate passes zero
// with its length. tau x' = sin(w t) + b - x from x(0) = c is, with s = 1 / (1 + (w tau)^2),
//   x = b + s (sin(w t) - w tau cos(w t)) + (c - b + s w tau) exp(-t / tau).
#include <cmath>

#include "support/draw.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

struct ForcedLag {
  double tau, w, b, c;

  double at(double t) const {
    const double s = 1.0 / (1.0 + w * tau * w * tau);
    return b + s * (std::sin(w * t) - w * tau * std::cos(w * t)) +
           (c - b + s * w * tau) * std::exp(-t / tau);
  }
  Leaf leaf() const {
    return Leaf("lag", [of = *this](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({of.c}), .ode = [of](const At& at, VectorRef rate) {
             rate[0] = (std::sin(of.w * at.time) + of.b - at.x[0]) / of.tau;
           }});
    });
  }
};

}  // namespace

TEST_CASE("no length of the first step is taken because its error estimate is zero", "[laws]") {
  Draw draw(3);
  for (int i = 0; i < 5000; ++i) {
    const ForcedLag lag{draw(0.2, 2.0), draw(0.5, 4.0), draw(-2.0, 2.0), draw(-2.0, 2.0)};
    const Leaf leaf = lag.leaf();
    const double end = draw(0.1, 3.0);
    for (const Method method : {Method::dopri5, Method::dop853}) {
      const double rtol = std::pow(10.0, draw(-10.0, -6.0));
      const Results results =
          simulate(leaf, leaf.create_context(), {0.0, end},
                   {.rtol = rtol, .atol = rtol, .ode_solver_method = method, .first_step = end});
      INFO(to_string(method) << ", tau " << lag.tau << ", w " << lag.w << ", b " << lag.b << ", c "
                             << lag.c << ", to " << end << " s, rtol " << rtol);
      // e3^2 / m is 12 500 tolerances at most where the estimate counts (Dop853::corrected), and the
      // error is a twentieth of that.
      CHECK(std::abs(results.context.continuous_state()[0] - lag.at(end)) < 1000.0 * rtol);
    }
  }
}
