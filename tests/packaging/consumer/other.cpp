#include <saltus/saltus.hpp>

namespace {

class Ball final : public saltus::LeafSystem {
 public:
  Ball() : LeafSystem("ball") {
    declare_continuous_state(2, &Ball::ode);
    declare_continuous_state_output("ball:y");
  }

 private:
  void ode(const At& at, VectorRef xdot) const { xdot << at.x[1], -9.81; }
};

}  // namespace

double simulated_height(double time) {
  const Ball ball;
  const auto context = ball.create_context().with_continuous_state({10.0, 0.0});
  const auto results = saltus::simulate(ball, context, {0.0, time}, {.rtol = 1e-10, .atol = 1e-12});
  return results.context.continuous_state()[0];
}
