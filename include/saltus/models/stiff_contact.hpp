// A mass that falls on a stiff damped spring, bounces a few times and comes to rest on it.
//   dy/dt = v, dv/dt = -g                       above the floor, y > 0
//   dy/dt = v, dv/dt = -g - (k y + d v) / m     in contact
// State: height y [m], velocity v [m/s]. A contact lasts 1e-4 s between flights of a second. Once
// the mass rests the scene is stiff: rates of 1e4 /s, and nothing moves. K. L. Johnson, Contact
// Mechanics, 1985, for linear springs as models of impact; the spring and damper are Kelvin's and
// Voigt's.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct StiffContactParameters {
  double g = 9.81;       ///< [m/s^2]
  double m = 1.0;        ///< [kg]
  double k = 1e9;        ///< [N/m]
  double damping = 0.5;  ///< d / (2 sqrt(k m)), 0 <= damping < 1
  double y0 = 1e-3;      ///< [m] above the floor
  double t_end = 10.0;   ///< [s]
};

class StiffContact final : public LeafSystem {
 public:
  enum Mode { flight, contact };

  explicit StiffContact(const StiffContactParameters& with)
      : LeafSystem("mass"), with_(with), d_(2.0 * with.damping * std::sqrt(with.k * with.m)) {
    declare_continuous_state({.initial = Eigen::Vector2d(with.y0, 0.0),
                              .ode = &StiffContact::ode,
                              .jacobian = &StiffContact::jacobian});
    declare_continuous_state_output("state");
    declare_default_mode(flight);
    declare_zero_crossing({.name = "touches",
                           .guard = [](const At& at) { return at.x[0]; },
                           .direction = Direction::positive_then_non_positive,
                           .start_mode = flight,
                           .end_mode = contact});
    declare_zero_crossing({.name = "leaves",
                           .guard = [](const At& at) { return at.x[0]; },
                           .direction = Direction::negative_then_non_negative,
                           .start_mode = contact,
                           .end_mode = flight});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double force = at.mode == contact ? -with_.k * at.x[0] - d_ * at.x[1] : 0.0;
    xdot << at.x[1], force / with_.m - with_.g;
  }
  void jacobian(const At& at, MatrixRef out) const {
    const double on = at.mode == contact ? 1.0 / with_.m : 0.0;
    out << 0.0, 1.0, -on * with_.k, -on * d_;
  }

  StiffContactParameters with_;
  double d_;  // [N s/m]
};

/// A flight, or a damped oscillation about -m g / k.
struct Touch {
  Real g, w, damping, begin, y, v;
  bool touches;

  Real decay() const { return -damping * w; }
  Real ring() const { return w * std::sqrt((1 - damping) * (1 + damping)); }
  std::pair<Real, Real> at(Real t) const {
    const Real d = t - begin;
    if (!touches) return {y + d * (v - g * d / 2), v - g * d};
    const Real rests = -g / (w * w), z = y - rests, e = std::exp(decay() * d),
               c = e * std::cos(ring() * d), s = e * std::sin(ring() * d) / ring();
    return {rests + c * z + s * (v - decay() * z), c * v + s * (decay() * v - w * w * z)};
  }
  Eigen::VectorXd state(Real t) const {
    const auto [height, speed] = at(t);
    return Eigen::Vector2d(static_cast<double>(height), static_cast<double>(speed));
  }
  /// The end of a contact: within one turn, or never.
  std::optional<Real> end() const {
    if (!touches) return begin + (v + std::sqrt(v * v + 2 * g * y)) / g;
    const Real turn = 2 * std::acos(Real(-1)) / ring();
    return first_root([&](Real t) { return at(t).first; }, begin, turn / 1000, begin + turn);
  }
};

inline ExactPieces<Touch> touches(const StiffContactParameters& with) {
  insist(with.g > 0 && with.m > 0 && with.k > 0, "stiff contact", "g, m, k > 0",
         std::min({with.g, with.m, with.k}));
  insist(with.damping >= 0 && with.damping < 1, "stiff contact", "0 <= damping < 1", with.damping);
  insist(with.y0 > 0, "stiff contact", "y0 above the floor", with.y0);
  const Real g = with.g, w = std::sqrt(Real(with.k) / with.m), damping = with.damping;
  ExactPieces<Touch> all{.pieces = {{g, w, damping, 0, with.y0, 0, false}}};
  for (;;) {
    const Touch now = all.pieces.back();
    const auto end = now.end();
    if (!end || *end > with.t_end) return all;
    all.times.push_back(static_cast<double>(*end));
    all.pieces.push_back({g, w, damping, *end, 0, now.at(*end).second, !now.touches});
  }
}

/// There are three contacts with the defaults; the last one does not end. Records the state (y, v).
///
/// Growth: an error rtol y0 of the height moves the touch by rtol y0 / v and the speed at a given
/// time of the contact, at accelerations up to w v, by rtol w y0 = 3e-5 m/s; where the speed passes
/// zero the error counts against atol. There the damped swing has half of w y0 rtol / atol = 3e5
/// left.
inline Scene stiff_contact(const StiffContactParameters& with = {}) {
  const auto mass = std::make_shared<const StiffContact>(with);
  return {
      .name = "stiff contact",
      .system = mass,
      .context = mass->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-10, .recorded_signals = {{"state", mass->output(0)}}},
      .exact =
          pieces_answer("parabolas and damped circles, joined by bisection in extended precision",
                        "mass.*", touches(with)),
      .methods = {Method::bdf, Method::radau, Method::automatic},
      .growth = 2e5};
}

}  // namespace saltus::models
