// Two draining tanks and one tap. The tap turns to a tank when that tank has drained to its mark.
//   dx1/dt = (w in mode `first`) - v1,  dx2/dt = (w in mode `second`) - v2
//   first -> second when x2 falls to r2,  second -> first when x1 falls to r1
// State: volumes x1, x2 [m^3]. With w < v1 + v2 the switches accumulate at (x1 + x2 - r1 - r2) /
// (v1 + v2 - w) from the start, without any reset: Zeno by modes. R. Alur, T. Henzinger,
// "Modularity for timed and hybrid systems", CONCUR 1997; K. H. Johansson, M. Egerstedt, J.
// Lygeros, S. Sastry, "On the regularization of Zeno hybrid automata", Systems & Control Letters 38
// (1999) 141.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct WaterTanksParameters {
  double w = 0.75;            ///< [m^3/s] inflow
  double v1 = 0.5, v2 = 0.5;  ///< [m^3/s] outflows, each below w, together above it
  double r1 = 0.0, r2 = 0.0;  ///< [m^3] marks
  double x1 = 1.0, x2 = 1.0;  ///< [m^3] at the start, above the marks
  double t_end = 12.0;        ///< [s]

  double accumulation() const { return (x1 + x2 - r1 - r2) / (v1 + v2 - w); }
};

class WaterTanks final : public LeafSystem {
 public:
  enum Mode { first = 1, second = 2 };  ///< where the inflow goes

  explicit WaterTanks(const WaterTanksParameters& with) : LeafSystem("tanks"), with_(with) {
    declare_continuous_state(
        {.initial = Eigen::Vector2d(with.x1, with.x2), .ode = &WaterTanks::ode});
    declare_continuous_state_output("volumes");
    declare_default_mode(first);
    declare_zero_crossing({.name = "second_low",
                           .guard = [with](const At& at) { return at.x[1] - with.r2; },
                           .direction = Direction::positive_then_non_positive,
                           .start_mode = first,
                           .end_mode = second});
    declare_zero_crossing({.name = "first_low",
                           .guard = [with](const At& at) { return at.x[0] - with.r1; },
                           .direction = Direction::positive_then_non_positive,
                           .start_mode = second,
                           .end_mode = first});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    xdot << (at.mode == first ? with_.w : 0.0) - with_.v1,
        (at.mode == second ? with_.w : 0.0) - with_.v2;
  }

  WaterTanksParameters with_;
};

struct Filling {
  Real begin, x1, x2, rate1, rate2;

  Eigen::VectorXd state(Real t) const {
    return Eigen::Vector2d(static_cast<double>(x1 + rate1 * (t - begin)),
                           static_cast<double>(x2 + rate2 * (t - begin)));
  }
};

/// Each time the tank without inflow drains to its mark. These times shrink geometrically; times
/// below 1e-18 of the first are left out.
inline ExactPieces<Filling> fillings(const WaterTanksParameters& with) {
  insist(with.v1 > 0 && with.v1 < with.w, "water tanks", "0 < v1 < w", with.v1);
  insist(with.v2 > 0 && with.v2 < with.w, "water tanks", "0 < v2 < w", with.v2);
  insist(with.v1 + with.v2 > with.w, "water tanks", "v1 + v2 > w", with.v1 + with.v2);
  insist(with.x1 > with.r1, "water tanks", "x1 above its mark", with.x1);
  insist(with.x2 > with.r2, "water tanks", "x2 above its mark", with.x2);
  const Real w = with.w, v1 = with.v1, v2 = with.v2;
  ExactPieces<Filling> all{.pieces = {{0, with.x1, with.x2, w - v1, -v2}},
                           .rest = Eigen::Vector2d(with.r1, with.r2)};
  for (Real lasts = 0, once = (Real(with.x2) - with.r2) / v2;;) {
    const Filling now = all.pieces.back();
    const bool to_first = now.rate1 > 0;
    lasts = to_first ? (now.x2 - with.r2) / v2 : (now.x1 - with.r1) / v1;
    if (lasts < 1e-18L * once) break;
    const Real t = now.begin + lasts;
    if (t > with.t_end) return all;
    all.times.push_back(static_cast<double>(t));
    all.pieces.push_back(to_first ? Filling{t, now.x1 + now.rate1 * lasts, with.r2, -v1, w - v2}
                                  : Filling{t, with.r1, now.x2 + now.rate2 * lasts, w - v1, -v2});
  }
  if (with.accumulation() <= with.t_end) all.accumulation = with.accumulation();
  return all;
}

/// Both tanks are at their marks from 8 s on with the defaults. Records the state (x1, x2).
///
/// Growth: an error of a volume becomes an error of time of 1 / (v1 + v2 - w) = 4 s per m^3, in
/// which the volumes change by half of that, in weights of 2 and 1. No method makes this error: all
/// rates are constant.
inline Scene water_tanks(const WaterTanksParameters& with = {}) {
  const auto tanks = std::make_shared<const WaterTanks>(with);
  return {
      .name = "water tanks",
      .system = tanks,
      .context = tanks->create_context(),
      .span = {0.0, with.t_end},
      .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"volumes", tanks->output(0)}}},
      .exact = pieces_answer("closed form: straight lines", "tanks.*", fillings(with)),
      .gap =
          [with](double, const Eigen::VectorXd& row) {
            return std::min(row[0] - with.r1, row[1] - with.r2);
          },
      .growth = 5.0};
}

}  // namespace saltus::models
