// Kepler: a body on an ellipse about a fixed body; it is slow far out and fast at its closest
// point.
//   d^2 r / dt^2 = -mu r / |r|^3
// State x, y, dx/dt, dy/dt: lengths in semi-major axes, a = 1, mu = 1, so a turn takes 2 pi. The
// body starts at its closest point, (1 - e, 0), with the speed sqrt((1 + e) / (1 - e)). Parameters:
// mu in the context, the eccentricity e in the start. Monitor "apsis": r . dr/dt = 0, at t = k pi.
// Energy -1/2 and angular momentum sqrt(1 - e^2) are conserved. The answer is exact: x = cos E - e,
// y = sqrt(1 - e^2) sin E with E - e sin E = t, Kepler's equation.
#pragma once

#include <cmath>
#include <numbers>

#include "saltus/models/reference.hpp"

namespace saltus::models {

class Kepler final : public LeafSystem {
 public:
  explicit Kepler(double e = 0.6) : LeafSystem("planet") {
    if (!(e >= 0.0 && e < 1.0))
      throw ModelError(text("Kepler: expected an eccentricity 0 <= e < 1, found ", e));
    declare_continuous_state(
        {.initial = Eigen::Vector4d(1.0 - e, 0.0, 0.0, std::sqrt((1.0 + e) / (1.0 - e))),
         .ode = equations<4>([mu = declare_dynamic_parameter("mu", 1.0)](
                                 const auto& at, auto& xdot) { flow(mu, at, xdot); })});
    declare_continuous_state_output("r");
    declare_zero_crossing({.name = "apsis", .formula = Formula([](const auto& at) {
                                                         return at.x(0) * at.x(2) +
                                                                at.x(1) * at.x(3);
                                                       }).called()});
  }

 private:
  static void flow(ParameterIndex mu, const auto& at, auto& xdot) {
    using std::sqrt;
    const auto r2 = at.x(0) * at.x(0) + at.x(1) * at.x(1), w = -at.p(mu, 0) / (r2 * sqrt(r2));
    xdot[0] = at.x(2), xdot[1] = at.x(3);
    xdot[2] = w * at.x(0), xdot[3] = w * at.x(1);
  }
};

struct KeplerParameters {
  double e = 0.6;       ///< eccentricity, 0 <= e < 1
  double t_end = 60.0;  ///< in units of a turn over 2 pi: nine turns and a half
};

namespace detail {

/// The state at t. Newton's method on Kepler's equation, in long double; from E = pi it converges
/// for each e < 1 and each t within half a turn, since E - e sin E is convex there.
inline Eigen::VectorXd kepler_state(long double e, double t) {
  constexpr long double pi = std::numbers::pi_v<long double>;
  const long double anomaly = std::remainder(static_cast<long double>(t), 2 * pi);
  long double E = anomaly < 0 ? -pi : pi;
  for (int i = 0; i < 60; ++i) {
    const long double step = (E - e * std::sin(E) - anomaly) / (1 - e * std::cos(E));
    E -= step;
    if (std::abs(step) <= 1e-19L * std::abs(E)) break;
  }
  const long double b = std::sqrt(1 - e * e), rate = 1 / (1 - e * std::cos(E));
  return Eigen::Vector<long double, 4>(std::cos(E) - e, b * std::sin(E), -rate * std::sin(E),
                                       rate * b * std::cos(E))
      .cast<double>();
}

inline Exact kepler_answer(const KeplerParameters& with) {
  std::vector<double> times;
  for (double k = 1.0; k * std::numbers::pi <= with.t_end; ++k)
    times.push_back(k * std::numbers::pi);
  // On a circle each point is an apsis.
  return {.provenance = "closed form: Kepler's equation in long double",
          .events = with.e > 0.0 ? std::vector{firings("planet.apsis", std::move(times))}
                                 : std::vector<EventTimes>{},
          .state = [e = with.e](double t, const Branch&) { return kepler_state(e, t); }};
}

}  // namespace detail

/// Records "r", the state, at each step. An error of the energy is an error of the period, and
/// shifts the body along the orbit, more with each turn. With e = 0.6 over 60 the growth (measured
/// as in hires.hpp) is 1.9e4, from the closest point to the closest point nine turns later.
inline Scene kepler(const KeplerParameters& with = {}) {
  const auto planet = std::make_shared<const Kepler>(with.e);
  return {
      .name = "Kepler",
      .system = planet,
      .context = planet->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"r", planet->output(0)}}},
      .exact = detail::kepler_answer(with),
      .invariants = {{"energy",
                      [](double, const Eigen::VectorXd& s) {
                        return 0.5 * s.tail<2>().squaredNorm() - 1.0 / s.head<2>().norm();
                      }},
                     {"angular momentum",
                      [](double, const Eigen::VectorXd& s) { return s[0] * s[3] - s[1] * s[2]; }}},
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor, Method::automatic},
      .growth = 1.9e4};
}

}  // namespace saltus::models
