// y[k] = u[k], but at least y[k-1] + dt lower_limit and at most y[k-1] + dt upper_limit;
#include "saltus/library/rate_limiter.hpp"

#include <algorithm>

#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

RateLimiter::RateLimiter(std::string name, double dt, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::require_period(this->name(), "dt", dt);
  const ParameterIndex lower = declare_dynamic_parameter("lower_limit", options.lower_limit);
  const ParameterIndex upper = declare_dynamic_parameter("upper_limit", options.upper_limit);
  declare_parameter_check(detail::ordered(lower, upper, " /s"));
  const Shape shape = options.initial_state.shape();
  Eigen::VectorXd z(shape.size + 1);
  z << options.initial_state.values, 0.0;  // y, and whether there was a tick
  declare_discrete_state(z);
  declare_input_port({.name = "in", .shape = shape});
  declare_output_port({.name = "out",
                       .shape = shape,
                       .reads = Reads::discrete_state,
                       .view = Place{Space::z, 0, shape.size}});
  const auto follow = [=, n = shape.size](const At& at, Next& next) {
    Eigen::VectorXd now = at.z;
    const double down = dt * at.p[lower], up = dt * at.p[upper];
    for (Index i = 0; i < n; ++i) {
      const double u = at.u[0][i];
      now[i] = at.z[n] == 0.0 ? u : std::clamp(u, at.z[i] + down, at.z[i] + up);
    }
    now[n] = 1.0;
    next.set_discrete_state(now);
  };
  declare_periodic_update(follow, dt, 0.0, "tick");
}

}  // namespace saltus
