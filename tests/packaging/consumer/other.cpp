#include <saltus/analysis.hpp>
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

/// A body of 2 kg on a scale that pushes.
class Scale final : public saltus::LeafSystem {
 public:
  Scale() : LeafSystem("scale") {
    const auto push = declare_dynamic_parameter("push", 1.0);
    declare_continuous_state({.initial = Eigen::VectorXd::Zero(1),
                              .ode = [push](const At& at) { return at.p[push] / 2.0 - 9.81; }});
  }
};

}  // namespace

double found_weight() {
  const Scale scale;
  const saltus::OperatingPoint point =
      saltus::trim(scale, scale.create_context(), {.free = {{{.name = "push"}}}});
  return point.value("push");
}

double simulated_height(double time) {
  const Ball ball;
  const auto context = ball.create_context().with_continuous_state({10.0, 0.0});
  const auto results = saltus::simulate(ball, context, {0.0, time}, {.rtol = 1e-10, .atol = 1e-12});
  return results.context.continuous_state()[0];
}
