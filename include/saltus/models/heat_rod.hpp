// Heated rod: the heat equation on a line, by the method of lines, with a coil around its left half
// that a thermostat switches by the temperature at three quarters. The scene is stiff with the rate
// 4 kappa (N + 1)^2, of any size, and hybrid; its solution is known exactly (heat_rod_modes.hpp).
//   du_i/dt = kappa ((N + 1) / L)^2 (u_{i-1} - 2 u_i + u_{i+1}) + (power where x_i <= L/2, heating)
//   heating -> cooling when u at 3 L/4 rises to high; cooling -> heating when it falls to low
// State: temperatures u_i [K] above the surroundings at x_i = i L / (N + 1), L = 1 m; both ends are
// held at 0; u(0) = 0 and the coil is on. Parameters kappa [m^2/s] and power [K/s] in the context,
// N, low, high in the block. The event "switch" is either change: its guard is high - u while
// heating and u - low while cooling. The equation: J. Crank, The Mathematics of Diffusion; the
// thermostat is the usual example of hybrid systems.
#pragma once

#include "saltus/models/heat_rod_modes.hpp"
#include "saltus/models/reference.hpp"

namespace saltus::models {

class HeatRod final : public LeafSystem {
 public:
  enum Mode { cooling, heating };

  explicit HeatRod(const HeatRodProblem& with = {}) : LeafSystem("rod"), with_(with) {
    declare_continuous_state(with.n, &HeatRod::ode);
    declare_jacobian_sparsity(band_entries(with.n, 1, 1));
    declare_continuous_state_output("u");
    declare_default_mode(heating);
    declare_mode_output("heating");
    kappa_ = declare_dynamic_parameter("kappa", with.kappa);
    power_ = declare_dynamic_parameter("power", with.power);
    declare_zero_crossing({.name = "switch",
                           .guard = &HeatRod::distance,
                           .reset_map = &HeatRod::change,
                           .direction = Direction::positive_then_non_positive});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    const Index n = with_.n;
    const double intervals = static_cast<double>(n + 1), d = at.p[kappa_] * intervals * intervals,
                 heat = at.mode == heating ? at.p[power_] : 0.0;
    for (Index i = 0; i < n; ++i) {
      const double left = i > 0 ? at.x[i - 1] : 0.0, right = i < n - 1 ? at.x[i + 1] : 0.0;
      xdot[i] = d * (left - 2.0 * at.x[i] + right) + (i < with_.heated() ? heat : 0.0);
    }
  }
  double distance(const At& at) const {
    const double u = at.x[with_.sensor()];
    return at.mode == heating ? with_.high - u : u - with_.low;
  }
  void change(const At& at, Next& next) const {
    next.set_mode(at.mode == heating ? cooling : heating);
  }

  HeatRodProblem with_;
  ParameterIndex kappa_, power_;
};

/// Records "u", the state, at each step; ten switches with the defaults. The growth is measured: a
/// change of 1e-5 (1 + u) in every node at t = 0.3 makes errors up to 10.4 times as large relative
/// to 1 + u, and a change at t = 0, 0.02, 0.05, 0.1, 0.2 or 0.5 makes smaller ones; N = 31 and 127
/// are alike. Errors of one sign are the worst, by the maximum principle. Conduction alone enlarges
/// no error: errors become early switches.
inline Scene heat_rod(const HeatRodProblem& with = {}) {
  Exact exact = detail::heat_rod_answer(with, "rod.switch");
  const auto rod = std::make_shared<const HeatRod>(with);
  return {.name = "heated rod",
          .system = rod,
          .context = rod->create_context(),
          .span = {0.0, with.t_end},
          .options = {.rtol = 1e-6, .atol = 1e-6, .recorded_signals = {{"u", rod->output(0)}}},
          .exact = std::move(exact),
          .methods = {Method::bdf, Method::radau, Method::automatic},
          .growth = 10.5};
}

}  // namespace saltus::models
