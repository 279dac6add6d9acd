// VDPOL: Van der Pol's oscillator with the time in units of mu, as in the literature of stiff
// methods; epsilon = 1 / mu^2.
//   dx/dt = v, dv/dt = ((1 - x^2) v - x) / epsilon
// State x, v, without units, as is time; x(0) = 2, v(0) = 0. A transient of epsilon, a slow motion
// until t = 0.807, a jump that lasts about epsilon and in which v reaches 4/3 / sqrt(epsilon), and
// so on. Parameter epsilon: 1e-6 (mu = 1000) in the Test Set, 1e-12 (mu = 1e6) to go further.
// Monitor "zero": x = 0, in the middle of a jump. van_der_pol.hpp has the same equation in its own
// time. E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, p. 4 and 144; Test Set
// for IVP Solvers, VDPOL.
#pragma once

#include "saltus/models/reference.hpp"

namespace saltus::models {

class Vdpol final : public LeafSystem {
 public:
  explicit Vdpol(double epsilon = 1e-6) : LeafSystem("oscillator") {
    declare_continuous_state(
        {.initial = Eigen::Vector2d(2.0, 0.0), .ode = &Vdpol::ode, .jacobian = &Vdpol::jacobian});
    declare_continuous_state_output("x");
    epsilon_ = declare_dynamic_parameter("epsilon", epsilon);
    declare_zero_crossing({.name = "zero", .guard = [](const At& at) { return at.x[0]; }});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double x = at.x[0], v = at.x[1];
    xdot << v, ((1.0 - x * x) * v - x) / at.p[epsilon_];
  }
  void jacobian(const At& at, MatrixRef out) const {
    const double x = at.x[0], v = at.x[1], epsilon = at.p[epsilon_];
    out << 0.0, 1.0,  //
        (-2.0 * x * v - 1.0) / epsilon, (1.0 - x * x) / epsilon;
  }

  ParameterIndex epsilon_;
};

struct VdpolParameters {
  double epsilon = 1e-6;  ///< 1 / mu^2
  double t_end = 2.0;
};

namespace detail {

/// Test Set, epsilon = 1e-6, t = 2: 1.706167732170483, -0.8928097010247975; 2e-14 from this one.
inline Exact vdpol_reference(double epsilon) {
  if (epsilon == 1e-6)
    return {.provenance =
                "Radau IIA of order 13 in 34 digits, agrees with order 9 to 16 digits; "
                "the end with Test Set for IVP Solvers, VDPOL, to 13",
            .events = {firings("oscillator.zero", {0.80708474081587789, 1.6142853037200449})},
            .samples = {
                {0.5, column({1.5967689510526617, -1.0303911878393568})},
                {1, column({-1.8636462548081338, 0.75354308654354341})},
                {1.5, column({-1.3547459194866034, 1.6217887275973966})},
                {2, column({1.7061677321704649, -0.89280970102481649})},
            }};
  if (epsilon == 1e-12)
    return {.provenance =
                "Radau IIA of order 13 in 34 digits, agrees with order 9 to 18 digits; "
                "CVODE's BDF at 1e-11 to 9",
            .events = {firings("oscillator.zero", {0.80685284281848102, 1.6137056973248800})},
            .samples = {
                {0.5, column({1.5967683944579312, -1.0303929933620541})},
                {1, column({-1.8633839229390858, 0.75373521198381055})},
                {1.5, column({-1.3541800695772745, 1.6240994531085464})},
                {2, column({1.7055462175353784, -0.89347636254652829})},
            }};
  return {.provenance = "none: epsilon is neither 1e-6 nor 1e-12"};
}

}  // namespace detail

/// Records "x", the state (x, v), at the times of the reference, which are in the slow motion. The
/// growth is measured at these rows as in hires.hpp. Within a jump it is 1 / sqrt(epsilon); after
/// the jump a small shift of time remains.
inline Scene vdpol(const VdpolParameters& with = {}) {
  const auto oscillator = std::make_shared<const Vdpol>(with.epsilon);
  return detail::with_rows_at_samples(
      {.name = "VDPOL",
       .system = oscillator,
       .context = oscillator->create_context(),
       .span = {0.0, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1e-8, .recorded_signals = {{"x", oscillator->output(0)}}},
       .exact = detail::until(with.t_end, 2.0, detail::vdpol_reference(with.epsilon)),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 12.3});
}

}  // namespace saltus::models
