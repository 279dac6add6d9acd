// A leaky integrate-and-fire neuron, driven by an oscillating current.
//   tau du/dt = -u + a + b sin(w t)      below the threshold
//   u+ = reset                           when u rises to the threshold
// State: membrane potential above rest, u [mV]; a and b are currents times the membrane's
// resistance [mV]. The spike train is at the edge of phase locking: where u only just reaches the
// threshold, a small error loses or adds a spike. L. Lapicque, J. Physiol. Pathol. Gen. 9 (1907)
// 620; J. P. Keener, F. C. Hoppensteadt, J. Rinzel, "Integrate-and-fire models of nerve membrane
// response to oscillatory input", SIAM J. Appl. Math. 41 (1981) 503.
#pragma once

#include <numbers>

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct IntegrateAndFireParameters {
  double tau = 0.02;                      ///< [s]
  double a = 16.0;                        ///< [mV] mean drive
  double b = 6.0;                         ///< [mV] its oscillation
  double w = 2.0 * std::numbers::pi * 8;  ///< [rad/s]
  double threshold = 15.0;                ///< [mV]
  double reset = 0.0;                     ///< [mV]
  double t_end = 1.0;                     ///< [s]
};

class IntegrateAndFire final : public LeafSystem {
 public:
  explicit IntegrateAndFire(const IntegrateAndFireParameters& with) : LeafSystem("neuron") {
    declare_continuous_state(
        {.initial = Eigen::VectorXd::Constant(1, with.reset),
         .ode = equations<1>([with](const auto& at, auto& xdot) {
           using std::sin;
           xdot[0] = (with.a + with.b * sin(with.w * at.time()) - at.x(0)) / with.tau;
         }),
         .jacobian = [with](const At&, MatrixRef out) { out << -1.0 / with.tau; }});
    declare_continuous_state_output("potential");
    declare_zero_crossing(
        {.name = "spike",
         .reset_map = [with](const At&, Next& next) { next.set_continuous_state({with.reset}); },
         .direction = Direction::negative_then_non_negative,
         .formula = Formula([with](const auto& at) { return at.x(0) - with.threshold; }).called()});
  }
};

/// The steady answer to the drive, and the decaying part from the reset.
struct Charging {
  IntegrateAndFireParameters with;
  Real begin, from;

  Real steady(Real t) const {
    const Real w = with.w, r = w * with.tau;
    return with.a + with.b * (std::sin(w * t) - r * std::cos(w * t)) / (1 + r * r);
  }
  Real potential(Real t) const {
    return steady(t) + (from - steady(begin)) * std::exp(-(t - begin) / Real(with.tau));
  }
  Eigen::VectorXd state(Real t) const {
    return Eigen::VectorXd::Constant(1, static_cast<double>(potential(t)));
  }
};

/// The search for spikes steps by a thousandth of tau.
inline ExactPieces<Charging> spikes(const IntegrateAndFireParameters& with) {
  insist(with.tau > 0, "integrate and fire", "tau > 0", with.tau);
  insist(with.reset < with.threshold, "integrate and fire", "a reset below threshold", with.reset);
  ExactPieces<Charging> all{.pieces = {{with, 0, with.reset}}};
  for (;;) {
    const Charging now = all.pieces.back();
    const auto below = [&](Real t) { return now.potential(t) - with.threshold; };
    const auto spike = first_root(below, now.begin, Real(with.tau) / 1000, with.t_end);
    if (!spike || *spike > with.t_end) return all;
    all.times.push_back(static_cast<double>(*spike));
    all.pieces.push_back({with, *spike, with.reset});
  }
}

/// Records the potential.
///
/// Growth: a spike resets the potential, and turns its error into an error of time by 1 / (du/dt)
/// there. The train is locked to the drive, so this error dies out. Each of 17 pieces adds 2 to
/// 3.5, in total 40 (perturbed runs at 1e-13).
inline Scene integrate_and_fire(const IntegrateAndFireParameters& with = {}) {
  const auto neuron = std::make_shared<const IntegrateAndFire>(with);
  return {.name = "integrate and fire",
          .system = neuron,
          .context = neuron->create_context(),
          .span = {0.0, with.t_end},
          .options = {.rtol = 1e-6,
                      .atol = 1e-5,
                      .recorded_signals = {{"potential", neuron->output(0)}}},
          .exact =
              pieces_answer("closed form between spikes, spikes by bisection in extended precision",
                            "neuron.spike", spikes(with)),
          .gap = [with](double, const Eigen::VectorXd& row) { return with.threshold - row[0]; },
          .methods = {Method::dopri5, Method::dop853, Method::adams, Method::bdf, Method::radau,
                      Method::taylor, Method::automatic},
          .growth = 40.0};
}

}  // namespace saltus::models
