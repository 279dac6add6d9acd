// Stiff B5: a linear problem whose eigenvalues -10 +- 100 j lie near the imaginary axis, where the
// higher formulas of BDF are unstable.
//   dx1/dt = -10 x1 + alpha x2,  dx2/dt = -alpha x1 - 10 x2
//   dx3/dt = -4 x3,  dx4/dt = -x4,  dx5/dt = -x5 / 2,  dx6/dt = -x6 / 10,  all 1 at t = 0
// State x without units, as is time. Parameter alpha. The oscillation has died out at t = 3, and
// from there on a step is bounded by stability alone. W. H. Enright, T. E. Hull, B. Lindberg,
// "Comparing numerical methods for stiff systems of O.D.E:s", BIT 15 (1975) 10, class B5.
#pragma once

#include "saltus/models/reference.hpp"

namespace saltus::models {

class B5 final : public LeafSystem {
 public:
  explicit B5(double alpha = 100.0) : LeafSystem("circuit") {
    declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(6), .ode = &B5::ode, .jacobian = &B5::jacobian});
    declare_continuous_state_output("x");
    alpha_ = declare_dynamic_parameter("alpha", alpha);
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const VectorView& x = at.x;
    const double alpha = at.p[alpha_];
    xdot << -10.0 * x[0] + alpha * x[1], -alpha * x[0] - 10.0 * x[1], -4.0 * x[2], -x[3],
        -0.5 * x[4], -0.1 * x[5];
  }
  void jacobian(const At& at, MatrixRef out) const {
    out.setZero();
    out.diagonal() << -10.0, -10.0, -4.0, -1.0, -0.5, -0.1;
    out(0, 1) = at.p[alpha_], out(1, 0) = -at.p[alpha_];
  }

  ParameterIndex alpha_;
};

struct B5Parameters {
  double alpha = 100.0;
  double t_end = 20.0;
};

namespace detail {

inline Eigen::VectorXd b5_state(double alpha, double t) {
  const long double time = t, c = std::cos(alpha * time), s = std::sin(alpha * time);
  const auto decay = [&](long double rate) { return std::exp(-rate * time); };
  return Eigen::Vector<long double, 6>(decay(10) * (c + s), decay(10) * (c - s), decay(4), decay(1),
                                       decay(0.5L), decay(0.1L))
      .cast<double>();
}

}  // namespace detail

/// Records "x", the state, at each step. Growth: |x1| + |x2| of an error in both is at most sqrt 2
/// times what it was while the scales 1 + |x| fall from 2.4 to 1.
inline Scene b5(const B5Parameters& with = {}) {
  const auto circuit = std::make_shared<const B5>(with.alpha);
  return {.name = "stiff B5",
          .system = circuit,
          .context = circuit->create_context(),
          .span = {0.0, with.t_end},
          .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"x", circuit->output(0)}}},
          .exact = {.provenance = "closed form: exponentials and a rotation",
                    .state = [alpha = with.alpha](
                                 double t, const Branch&) { return detail::b5_state(alpha, t); }},
          .methods = {Method::bdf, Method::radau, Method::automatic},
          .growth = 2.0};
}

}  // namespace saltus::models
