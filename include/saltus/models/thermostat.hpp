// A room that a thermostat keeps between two temperatures.
//   dT/dt = (T_heater - T) / tau  in mode `on`,  off when T rises to `high`
//   dT/dt = (T_outside - T) / tau in mode `off`, on when T falls to `low`
// State: temperature T [degC]. It has two exponentials and two modes. Only its length makes it
// hard: errors of time add up from switch to switch. T. A. Henzinger, "The theory of hybrid
// automata", LICS 1996, figure 1.
#pragma once

#include "saltus/models/pieces.hpp"
#include "saltus/report/scene.hpp"

namespace saltus::models {

struct ThermostatParameters {
  double low = 19.0, high = 21.0;  ///< [degC] between them it is kept
  double outside = 10.0;           ///< [degC] below low
  double heater = 40.0;            ///< [degC] above high
  double tau = 1800.0;             ///< [s]
  double start = 19.0;             ///< [degC] from low up to below high, with the heater on
  double t_end = 43200.0;          ///< [s] half a day
};

class Thermostat final : public LeafSystem {
 public:
  enum Mode { off, on };

  explicit Thermostat(const ThermostatParameters& with) : LeafSystem("room") {
    declare_continuous_state(
        {.initial = Eigen::VectorXd::Constant(1, with.start),
         .ode = equations<1>([with](const auto& at, auto& xdot) {
           const auto source = at.choose(at.mode() == double(on), with.heater, with.outside);
           xdot[0] = (source - at.x(0)) / with.tau;
         }),
         .jacobian = [with](const At&, MatrixRef out) { out << -1.0 / with.tau; }});
    declare_continuous_state_output("temperature");
    declare_default_mode(on);
    declare_zero_crossing(
        {.name = "warm",
         .direction = Direction::negative_then_non_negative,
         .start_mode = on,
         .end_mode = off,
         .formula = Formula([with](const auto& at) { return at.x(0) - with.high; }).called()});
    declare_zero_crossing(
        {.name = "cold",
         .direction = Direction::positive_then_non_positive,
         .start_mode = off,
         .end_mode = on,
         .formula = Formula([with](const auto& at) { return at.x(0) - with.low; }).called()});
  }
};

struct Exponential {
  Real begin, from, towards, tau;

  Eigen::VectorXd state(Real t) const {
    return Eigen::VectorXd::Constant(
        1, static_cast<double>(towards + (from - towards) * std::exp(-(t - begin) / tau)));
  }
};

inline ExactPieces<Exponential> switches(const ThermostatParameters& with) {
  insist(with.low < with.high, "thermostat", "low below high", with.low);
  insist(with.outside < with.low, "thermostat", "outside below low", with.outside);
  insist(with.heater > with.high, "thermostat", "heater above high", with.heater);
  insist(with.start >= with.low && with.start < with.high, "thermostat", "low <= start < high",
         with.start);
  insist(with.tau > 0, "thermostat", "tau > 0", with.tau);
  ExactPieces<Exponential> all{.pieces = {{0, with.start, with.heater, with.tau}}};
  for (bool heats = true;; heats = !heats) {
    const Exponential now = all.pieces.back();
    const Real level = heats ? with.high : with.low,
               t = now.begin + now.tau * std::log((now.towards - now.from) / (now.towards - level));
    if (t > with.t_end) return all;
    all.times.push_back(static_cast<double>(t));
    all.pieces.push_back({t, level, heats ? with.outside : with.heater, with.tau});
  }
}

/// 159 switches with the defaults. Records the temperature.
///
/// Growth: an error dT moves the switch by tau dT over the rate there, 19 or 9 degrees, and the
/// temperature after it by the ratio of the rates, 2.1 or 1. So all switches carry the error on,
/// and the errors of 160 pieces add up to 1.6 times 160.
inline Scene thermostat(const ThermostatParameters& with = {}) {
  const auto room = std::make_shared<const Thermostat>(with);
  return {
      .name = "thermostat",
      .system = room,
      .context = room->create_context(),
      .span = {0.0, with.t_end},
      .options = {.recorded_signals = {{"temperature", room->output(0)}}},
      .exact = pieces_answer("closed form: exponentials and logarithms", "room.*", switches(with)),
      .gap =
          [with](double, const Eigen::VectorXd& row) {
            return std::min(row[0] - with.low, with.high - row[0]);
          },
      .growth = 260.0};
}

}  // namespace saltus::models
