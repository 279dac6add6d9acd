// A mass on a moving belt, held by a spring: it sticks until the spring pulls with the static
// friction, and slips under the lower kinetic one until its speed is the belt's again.
//   dx/dt = v, dv/dt = 0                          in mode `stick`, until k x rises to fs
//   dx/dt = v, m dv/dt = fk - k x                 in mode `slip`, until v rises to the belt's speed
// State: place x [m], velocity v [m/s]. It has two modes of different order, and a guard that is at
// zero when its mode begins. J. P. Den Hartog, Mechanical Vibrations, 1934, chapter VII, on
// self-excited vibrations.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct StickSlipParameters {
  double m = 1.0;       ///< [kg]
  double k = 1.0;       ///< [N/m]
  double belt = 0.1;    ///< [m/s]
  double fs = 1.0;      ///< [N] static friction
  double fk = 0.6;      ///< [N] kinetic friction, below fs
  double t_end = 60.0;  ///< [s]
};

class StickSlip final : public LeafSystem {
 public:
  enum Mode { stick, slip };

  explicit StickSlip(const StickSlipParameters& with) : LeafSystem("mass"), with_(with) {
    declare_continuous_state({.initial = Eigen::Vector2d(0.0, with.belt),
                              .ode = equations<2>([with](const auto& at, auto& xdot) {
                                xdot[0] = at.x(1);
                                xdot[1] = at.choose(at.mode() == double(stick), 0.0,
                                                    (with.fk - with.k * at.x(0)) / with.m);
                              })});
    declare_continuous_state_output("state");
    declare_default_mode(stick);
    declare_zero_crossing({.name = "slips",
                           .direction = Direction::negative_then_non_negative,
                           .start_mode = stick,
                           .end_mode = slip,
                           .formula = Formula([with](const auto& at) {
                                        return with.k * at.x(0) - with.fs;
                                      }).called()});
    declare_zero_crossing(
        {.name = "sticks",
         .reset_map = &StickSlip::catch_on,
         .direction = Direction::negative_then_non_negative,
         .start_mode = slip,
         .end_mode = stick,
         .formula = Formula([with](const auto& at) { return at.x(1) - with.belt; }).called()});
  }

 private:
  void catch_on(const At& at, Next& next) const {
    next.set_continuous_state({at.x[0], with_.belt});
  }

  StickSlipParameters with_;
};

/// x = centre + a cos w d + belt / w sin w d in a slip, x + belt d while it sticks.
struct Ride {
  Real begin, x, belt;
  Real w, centre;  // of a slip; w = 0: it sticks

  Eigen::VectorXd state(Real t) const {
    const Real d = t - begin, a = x - centre, s = std::sin(w * d), c = std::cos(w * d);
    if (w == 0)
      return Eigen::Vector2d(static_cast<double>(x + belt * d), static_cast<double>(belt));
    return Eigen::Vector2d(static_cast<double>(centre + a * c + belt / w * s),
                           static_cast<double>(belt * c - a * w * s));
  }
};

/// A slip begins at fs / k. It ends after 2 (pi - atan(w a / belt)) / w, with the same speed on the
/// other side of the centre fk / k.
inline ExactPieces<Ride> rides(const StickSlipParameters& with) {
  insist(with.m > 0 && with.k > 0, "stick-slip", "m > 0 and k > 0", std::min(with.m, with.k));
  insist(with.belt > 0, "stick-slip", "belt > 0", with.belt);
  insist(with.fk >= 0 && with.fk < with.fs, "stick-slip", "0 <= fk < fs", with.fk);
  const Real w = std::sqrt(Real(with.k) / with.m), belt = with.belt,
             centre = Real(with.fk) / with.k, a = Real(with.fs) / with.k - centre;
  const Real slips = 2 * (std::acos(Real(-1)) - std::atan(w * a / belt)) / w;
  ExactPieces<Ride> all{.pieces = {{0, 0, belt, 0, 0}}};
  for (bool sticks = true;; sticks = !sticks) {
    const Ride& now = all.pieces.back();
    const Real t = now.begin + (sticks ? (centre + a - now.x) / belt : slips);
    if (t > with.t_end) return all;
    all.times.push_back(static_cast<double>(t));
    all.pieces.push_back(sticks ? Ride{t, centre + a, belt, w, centre}
                                : Ride{t, centre - a, belt, 0, 0});
  }
}

/// Nine events with the defaults. Records the state (x, v).
///
/// Growth: an error of x becomes an error of time by 1 / belt when the mass slips, and an error of
/// v, with the acceleration (fs - fk) / m, by (fs - fk) / (m belt) = 4: a factor of 40 in weights
/// of 1.1 and 0.1. A slip ends at fk - (x - fk), so all nine events carry the error on: 500 in
/// total (perturbed runs at 1e-13).
inline Scene stick_slip(const StickSlipParameters& with = {}) {
  const auto mass = std::make_shared<const StickSlip>(with);
  return {
      .name = "stick-slip",
      .system = mass,
      .context = mass->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-7, .recorded_signals = {{"state", mass->output(0)}}},
      .exact = pieces_answer("closed form: lines and circles", "mass.*", rides(with)),
      .gap = [with](double, const Eigen::VectorXd& row) { return with.belt - row[1]; },
      .methods = {Method::dopri5, Method::dop853, Method::adams, Method::taylor, Method::automatic},
      .growth = 500.0};
}

}  // namespace saltus::models
