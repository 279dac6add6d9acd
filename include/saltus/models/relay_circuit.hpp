// Relay circuit: a relay with hysteresis turns a source on and off, which charges a capacitor
// through an RLC filter. The filter rings at 1e6 per second after each switch, the capacitor takes
// seconds.
//   L di/dt = u - R1 i - v1,  C1 dv1/dt = i - (v1 - v2) / R2,  C2 dv2/dt = (v1 - v2) / R2 - v2 / R3
//   u = E while the relay is on, else 0; off when v2 rises to high, on when it falls to low
// State: current i [A], voltages v1 and v2 [V]. It is linear in each mode; rates 5e5 +- 8.7e5 j and
// 1.5 per second. Events "off" and "on". The relay with hysteresis: A. F. Filippov, Differential
// Equations with Discontinuous Righthand Sides, 1988; the filter: any book on circuits.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/models/linear_flow.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct RelayCircuitParameters {
  double E = 10.0;                         ///< [V] source
  double L = 1e-4, R1 = 100.0, C1 = 1e-8;  ///< [H], [Ohm], [F] filter
  double R2 = 1e5, C2 = 1e-5, R3 = 2e5;    ///< [Ohm], [F], [Ohm] the charged part
  double low = 2.0, high = 4.0;            ///< [V] between them v2 is kept
  double t_end = 20.0;                     ///< [s]

  template <class Number>
  Eigen::Matrix<Number, 3, 3> matrix() const {
    const Number g2 = 1 / Number(R2), g3 = 1 / Number(R3);
    Eigen::Matrix<Number, 3, 3> a;
    a << -Number(R1) / Number(L), -1 / Number(L), 0,  //
        1 / Number(C1), -g2 / Number(C1), g2 / Number(C1), 0, g2 / Number(C2),
        -(g2 + g3) / Number(C2);
    return a;
  }
};

class RelayCircuit final : public LeafSystem {
 public:
  enum Mode { off, on };

  explicit RelayCircuit(const RelayCircuitParameters& with)
      : LeafSystem("circuit"), matrix_(with.matrix<double>()), slope_(with.E / with.L) {
    declare_continuous_state({.initial = Eigen::Vector3d::Zero(),
                              .ode = &RelayCircuit::ode,
                              .jacobian = &RelayCircuit::jacobian});
    declare_continuous_state_output("state");
    declare_default_mode(on);
    declare_zero_crossing({.name = "off",
                           .guard = [with](const At& at) { return at.x[2] - with.high; },
                           .direction = Direction::negative_then_non_negative,
                           .start_mode = on,
                           .end_mode = off});
    declare_zero_crossing({.name = "on",
                           .guard = [with](const At& at) { return at.x[2] - with.low; },
                           .direction = Direction::positive_then_non_positive,
                           .start_mode = off,
                           .end_mode = on});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    xdot = matrix_ * at.x;
    if (at.mode == on) xdot[0] += slope_;
  }
  void jacobian(const At&, MatrixRef out) const { out = matrix_; }

  Eigen::Matrix3d matrix_;
  double slope_;  // [A/s] of the source
};

inline ExactPieces<LinearPiece> charges(const RelayCircuitParameters& with) {
  insist(with.low < with.high, "relay circuit", "low below high", with.low);
  insist(with.low > 0, "relay circuit", "low above 0, where v2 goes to", with.low);
  const LinearFlow::Matrix a = with.matrix<Real>();
  std::array<std::shared_ptr<const LinearFlow>, 2> flows;
  for (std::size_t mode = 0; mode < 2; ++mode) {
    LinearFlow::Vector drive = LinearFlow::Vector::Zero(3);
    if (mode == RelayCircuit::on) drive[0] = Real(with.E) / with.L;
    nth(flows, mode) = std::make_shared<LinearFlow>(a, drive);
  }
  insist(flows[RelayCircuit::on]->rest()[2] > with.high, "relay circuit",
         "E R3 / (R1 + R2 + R3) above high", with.high);
  ExactPieces<LinearPiece> all{
      .pieces = {{0, LinearFlow::Vector::Zero(3), flows[RelayCircuit::on], RelayCircuit::on}}};
  for (;;) {
    const LinearPiece now = all.pieces.back();
    const Real level = now.mode == RelayCircuit::on ? with.high : with.low;
    const auto distance = [&](Real t) { return now.at(t)[2] - level; };
    const Real slow = Real(with.C2) * with.R2;
    const auto turn = first_change(distance, now.begin, slow / 1000, Real(with.t_end));
    if (!turn) return all;
    const int mode = 1 - now.mode;
    all.times.push_back(static_cast<double>(*turn));
    all.pieces.push_back({*turn, now.at(*turn), nth(flows, mode), mode});
  }
}

/// Records the state in the middle of each piece longer than 0.1 s.
///
/// Growth: an error of v2 moves a switch and is multiplied by the ratio of the rates there, 1.5 or
/// 2.3, which the decay until the next one undoes. So all switches carry the error on, and the
/// errors of 49 pieces add up, times 1.5 on average.
inline Scene relay_circuit(const RelayCircuitParameters& with = {}) {
  const auto circuit = std::make_shared<const RelayCircuit>(with);
  ExactPieces<LinearPiece> pieces = charges(with);
  std::vector<double> rows = mark_layers(pieces, 0.1L, with.t_end);
  return {.name = "relay circuit",
          .system = circuit,
          .context = circuit->create_context(),
          .span = {0.0, with.t_end},
          .options = {.rtol = 1e-6,
                      .atol = 1e-6,
                      .recorded_signals = {{"state", circuit->output(0)}},
                      .save_at = std::move(rows)},
          .exact = pieces_answer("matrix exponentials, levels by bisection in extended precision",
                                 "circuit.*", std::move(pieces)),
          .methods = {Method::bdf, Method::radau, Method::automatic},
          .growth = 75.0};
}

}  // namespace saltus::models
