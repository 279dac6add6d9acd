// A buck converter whose voltage is controlled by pulse-width modulation against a ramp.
//   L di/dt = s E - v, C dv/dt = i - v / R       s = 1: switch closed
//   open (s = 0) at each clock tick k T if a (v - v_ref) is above the ramp's lower end
//   closed (s = 1) when a (v - v_ref) falls to the ramp, low + (high - low) (t - k T) / T
// State: current i [A], voltage v [V]. It has a guard that moves, a clock that ticks at the same
// instants, and a sensitive loop: with more than 24.5 V input the period doubles on the way to
// chaos. D. C. Hamill, J. H. B. Deane, D. J. Jefferies, "Modeling of chaotic dc-dc converters by
// iterated nonlinear mappings", IEEE Trans. Power Electron. 7 (1992) 25; parameters of the circuit
// from there.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct BuckConverterParameters {
  double E = 20.0;               ///< [V] input
  double L = 20e-3;              ///< [H]
  double C = 47e-6;              ///< [F]
  double R = 22.0;               ///< [Ohm]
  double T = 400e-6;             ///< [s] of the clock
  double a = 8.4;                ///< gain of the loop
  double v_ref = 11.3;           ///< [V]
  double low = 3.8, high = 8.2;  ///< [V] ramp
  double i0 = 0.6, v0 = 12.0;    ///< [A], [V]
  double t_end = 0.0102;         ///< [s] 25 periods and a half

  double control(double v) const { return a * (v - v_ref); }
  template <class Number>
  Number ramp(Number since_tick) const {
    return Number(low) + (Number(high) - Number(low)) * since_tick / Number(T);
  }
};

class BuckConverter final : public LeafSystem {
 public:
  enum Switch { open, closed };

  explicit BuckConverter(const BuckConverterParameters& with) : LeafSystem("buck"), with_(with) {
    declare_continuous_state({.initial = Eigen::Vector2d(with.i0, with.v0),
                              .ode = &BuckConverter::ode,
                              .jacobian = &BuckConverter::jacobian});
    declare_continuous_state_output("state");
    declare_discrete_state(Eigen::VectorXd::Zero(1));  // time of the last tick [s]
    declare_default_mode(with.control(with.v0) > with.low ? open : closed);
    declare_zero_crossing({.name = "meets_ramp",
                           .guard = &BuckConverter::above_ramp,
                           .direction = Direction::positive_then_non_positive,
                           .start_mode = open,
                           .end_mode = closed});
    declare_periodic_update(&BuckConverter::tick, with.T, with.T, "tick");
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const double i = at.x[0], v = at.x[1];
    xdot << (at.mode * with_.E - v) / with_.L, (i - v / with_.R) / with_.C;
  }
  void jacobian(const At&, MatrixRef out) const {
    out << 0.0, -1.0 / with_.L, 1.0 / with_.C, -1.0 / (with_.R * with_.C);
  }
  double above_ramp(const At& at) const {
    return with_.control(at.x[1]) - with_.ramp(at.time - at.z[0]);
  }
  void tick(const At& at, Next& next) const {
    next.set_discrete_state({at.time});
    next.set_mode(with_.control(at.x[1]) > with_.low ? open : closed);
  }

  BuckConverterParameters with_;
};

/// x = x* + e^(A d) (x0 - x*), with the eigenvalues decay +- j ring of A.
struct Circuit {
  BuckConverterParameters with;
  Real begin, i, v;
  bool closed;

  std::pair<Real, Real> at(Real t) const {
    const Real L = with.L, C = with.C, R = with.R, d = t - begin, decay = -1 / (2 * R * C),
               ring = std::sqrt(1 / (L * C) - decay * decay);
    const Real vs = closed ? Real(with.E) : 0, is = vs / R, di = i - is, dv = v - vs;
    const Real e = std::exp(decay * d), c = e * std::cos(ring * d),
               s = e * std::sin(ring * d) / ring;
    return {is + c * di + s * (-dv / L - decay * di),
            vs + c * dv + s * (di / C - dv / (R * C) - decay * dv)};
  }
  Eigen::VectorXd state(Real t) const {
    const auto [it, vt] = at(t);
    return Eigen::Vector2d(static_cast<double>(it), static_cast<double>(vt));
  }
};

/// Goes from tick to tick; the switch closes where the control meets the ramp.
inline ExactPieces<Circuit> cycles(const BuckConverterParameters& with) {
  insist(with.L > 0 && with.C > 0 && with.R > 0 && with.T > 0, "buck converter", "L, C, R, T > 0",
         std::min({with.L, with.C, with.R, with.T}));
  insist(4 * with.R * with.R * with.C > with.L, "buck converter", "a circuit that rings",
         4 * with.R * with.R * with.C / with.L);
  const auto is_open = [&](Real v) { return with.a * (v - with.v_ref) > with.low; };
  ExactPieces<Circuit> all{.pieces = {{with, 0, with.i0, with.v0, !is_open(with.v0)}}};
  const auto go_on = [&](Real t, auto closed) {
    const auto [i, v] = all.pieces.back().at(t);
    all.times.push_back(static_cast<double>(t));
    all.pieces.push_back({with, t, i, v, closed(v)});
  };
  for (int k = 0;; ++k) {
    const Real tick = k * Real(with.T), next = (k + 1) * Real(with.T),
               end = std::min(next, Real(with.t_end));
    if (const Circuit now = all.pieces.back(); !now.closed) {
      const auto above = [&](Real t) {
        return with.a * (now.at(t).second - with.v_ref) - with.ramp(t - tick);
      };
      const auto meets = first_root(above, tick, Real(with.T) / 1000, end);
      if (meets && *meets < end) go_on(*meets, [](Real) { return true; });
    }
    if (next > with.t_end) return all;
    go_on(next, [&](Real v) { return !is_open(v); });
  }
}

/// The circuit settles on one pulse in each of 25 cycles with the defaults; other starts end on
/// longer cycles. Records the state (i, v).
///
/// Growth: an error of i becomes an error of v by the impedance sqrt(L / C) = 20.6 ohm, and of the
/// time of a pulse by the loop's gain; on the stable cycle it dies out within a few cycles. Each of
/// 51 pieces adds 6 to 13, in total 460 (perturbed runs at 1e-13).
inline Scene buck_converter(const BuckConverterParameters& with = {}) {
  const auto buck = std::make_shared<const BuckConverter>(with);
  return {.name = "buck converter",
          .system = buck,
          .context = buck->create_context(),
          .span = {0.0, with.t_end},
          .options = {.rtol = 1e-6, .atol = 1e-7, .recorded_signals = {{"state", buck->output(0)}}},
          .exact = pieces_answer(
              "matrix exponentials, meetings with the ramp by bisection in extended precision",
              "buck.*", cycles(with)),
          .growth = 460.0};
}

}  // namespace saltus::models
