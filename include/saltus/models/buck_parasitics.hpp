// Buck converter with parasitics: the switch and the diode are resistors, small when they conduct
// and large when they do not; the node between them has a capacitance and the output capacitor an
// inductance. Rates of 1e9 and 5e8 per second beside a clock of 1e5 per second.
//   L di/dt = x - vo,  C dv/dt = j,  Lc dj/dt = vo - r j - v,  vo = R (i - j)
//   Cx dx/dt = (E - x) / Rs - x / Rd - i;  Rs, Rd: on or off
//   switch: closed at k T, opened duty T later; diode: conducts while x < 0
// State: current i of the coil [A], voltage v of the capacitor [V], voltage x of the switching node
// [V], current j of the capacitor [A]. It is linear in each of its four modes. Events: "close" and
// "open" by the clock, and "diode" where x passes 0: 50 ps after the switch closes, and when the
// coil has discharged the node. The circuit: R. W. Erickson, D. Maksimovic, Fundamentals of Power
// Electronics, chapters 2 and 4, with the parasitics of its real parts.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/models/linear_flow.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct BuckParasiticsParameters {
  double E = 20.0;               ///< [V] input
  double L = 100e-6;             ///< [H] coil
  double C = 10e-6;              ///< [F] output capacitor
  double R = 10.0;               ///< [Ohm] load
  double on = 0.1, off = 1e6;    ///< [Ohm] of the switch and of the diode
  double Cx = 10e-9;             ///< [F] of the switching node
  double Lc = 20e-9, r = 0.02;   ///< [H], [Ohm] in series with C
  double T = 10e-6, duty = 0.5;  ///< [s] of the clock, and the part of it that is closed
  double i0 = 0.75, v0 = 10.0;   ///< [A], [V]; x and j start from 0
  double t_end = 102.5e-6;       ///< [s] ten periods and a quarter

  bool closed(int mode) const { return mode % 2 == 1; }
  bool conducts(int mode) const { return mode >= 2; }
  /// d(state)/dt = A state + b in a mode.
  template <class Number>
  Eigen::Matrix<Number, 4, 4> matrix(int mode) const {
    const Number gs = 1 / Number(closed(mode) ? on : off),
                 gd = 1 / Number(conducts(mode) ? on : off);
    Eigen::Matrix<Number, 4, 4> a;
    a << -Number(R) / Number(L), 0, 1 / Number(L), Number(R) / Number(L),  //
        0, 0, 0, 1 / Number(C),                                            //
        -1 / Number(Cx), 0, -(gs + gd) / Number(Cx), 0,                    //
        Number(R) / Number(Lc), -1 / Number(Lc), 0, -(Number(R) + Number(r)) / Number(Lc);
    return a;
  }
  template <class Number>
  Eigen::Vector<Number, 4> drive(int mode) const {
    return {0, 0, Number(E) / Number(closed(mode) ? on : off) / Number(Cx), 0};
  }
};

class BuckParasitics final : public LeafSystem {
 public:
  explicit BuckParasitics(const BuckParasiticsParameters& with)
      : LeafSystem("converter"), with_(with) {
    for (int mode = 0; mode < 4; ++mode) {
      matrices_.push_back(with.matrix<double>(mode));
      drives_.push_back(with.drive<double>(mode));
    }
    declare_continuous_state({.initial = Eigen::Vector4d(with.i0, with.v0, 0.0, 0.0),
                              .ode = &BuckParasitics::ode,
                              .jacobian = &BuckParasitics::jacobian});
    declare_continuous_state_output("state");
    declare_default_mode(1);
    declare_zero_crossing(
        {.name = "diode",
         .guard = &BuckParasitics::blocked,
         .reset_map = [](const At& at, Next& next) { next.set_mode(at.mode ^ 2); },
         .direction = Direction::positive_then_non_positive});
    declare_periodic_update([](const At& at, Next& next) { next.set_mode(at.mode | 1); }, with.T,
                            with.T, "close");
    declare_periodic_update([](const At& at, Next& next) { next.set_mode(at.mode & 2); }, with.T,
                            with.duty * with.T, "open");
  }

 private:
  std::size_t mode(const At& at) const { return static_cast<std::size_t>(at.mode); }
  void ode(const At& at, VectorRef xdot) const {
    xdot = matrices_[mode(at)] * at.x + drives_[mode(at)];
  }
  void jacobian(const At& at, MatrixRef out) const { out = matrices_[mode(at)]; }
  /// Positive as long as the diode stays as it is.
  double blocked(const At& at) const { return with_.conducts(at.mode) ? -at.x[2] : at.x[2]; }

  BuckParasiticsParameters with_;
  std::vector<Eigen::Matrix4d> matrices_;
  std::vector<Eigen::Vector4d> drives_;
};

/// From tick to tick, and from one change of the diode to the next.
inline ExactPieces<LinearPiece> conduction(const BuckParasiticsParameters& with) {
  insist(with.duty > 0 && with.duty < 1, "buck converter", "0 < duty < 1", with.duty);
  List<std::shared_ptr<const LinearFlow>> flows;
  for (int mode = 0; mode < 4; ++mode)
    flows.push_back(std::make_shared<LinearFlow>(with.matrix<Real>(mode), with.drive<Real>(mode)));
  LinearFlow::Vector start(4);
  start << with.i0, with.v0, 0, 0;
  ExactPieces<LinearPiece> all{.pieces = {{0, start, flows[1], 1}}};
  const auto go_on = [&](Real t, int mode) {
    const LinearFlow::Vector from = all.pieces.back().at(t);
    all.times.push_back(static_cast<double>(t));
    all.pieces.push_back({t, from, flows[mode], mode});
  };
  for (int half = 1;; ++half) {
    const Real tick = half % 2 == 1 ? (half / 2) * Real(with.T) + Real(with.duty * with.T)
                                    : (half / 2) * Real(with.T);
    const Real end = std::min(tick, Real(with.t_end));
    for (;;) {
      const LinearPiece now = all.pieces.back();
      const auto node = [&](Real t) { return now.at(t)[2]; };
      const auto turn = first_change(node, now.begin, 1e-7L / (1 / Real(with.on * with.Cx)), end);
      if (!turn) break;
      go_on(*turn, now.mode ^ 2);
    }
    if (tick > with.t_end) return all;
    go_on(tick, half % 2 == 1 ? all.pieces.back().mode & 2 : all.pieces.back().mode | 1);
  }
}

/// Records the state in the middle of each piece longer than 0.1 us.
///
/// Growth: the node falls by 20 V in 0.2 us, so an error of i is one of 20 V / i of x where the
/// diode begins to conduct, 230 times as large in weights of 0.85 and 0.1. The errors of i of ten
/// cycles add up, and die out with the load in 0.2 ms: 1500 in total.
inline Scene buck_parasitics(const BuckParasiticsParameters& with = {}) {
  const auto converter = std::make_shared<const BuckParasitics>(with);
  ExactPieces<LinearPiece> pieces = conduction(with);
  std::vector<double> rows = mark_layers(pieces, 1e-7L, with.t_end);
  return {
      .name = "buck converter with parasitics",
      .system = converter,
      .context = converter->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6,
                  .atol = 1e-7,
                  .recorded_signals = {{"state", converter->output(0)}},
                  .save_at = std::move(rows)},
      .exact = pieces_answer("matrix exponentials, changes of the diode by bisection in extended "
                             "precision",
                             "converter.*", std::move(pieces)),
      .methods = {Method::bdf, Method::radau, Method::automatic},
      .growth = 1500.0};
}

}  // namespace saltus::models
