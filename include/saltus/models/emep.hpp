// EMEP: the chemistry of ozone in the lower air of Europe over four and a half days: 66 substances,
// 160 reactions and losses, light by day only.
//   dy/dt = emissions + sum over reactions of k(t) (product of the reactants) changes
// State: concentrations y [molecules/cm^3] in the order of emep_reactions.hpp; time in seconds,
// from 4 h of the first day to 20 h of the fifth. The rates (emep_rates.hpp) depend on the time of
// day: light by the zenith angle, water by the humidity. Light and deposition jump at 4 h and 20 h
// (the time event "sun", which changes the mode), and the humidity jumps at midnight (the time
// event "midnight", which sets the discrete state, the begin of the day). J. G. Verwer, D. Simpson,
// Appl. Numer. Math. 18 (1995) 413; Test Set for IVP Solvers, EMEP.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "saltus/base/list.hpp"
#include "saltus/models/emep_rates.hpp"
#include "saltus/models/emep_reactions.hpp"
#include "saltus/models/emep_reference.hpp"

namespace saltus::models {

class Emep final : public LeafSystem {
 public:
  enum Mode { night, day };
  static constexpr double hour = 3600.0, sunrise = 4.0 * hour, sunset = 20.0 * hour,
                          midnight = 24.0 * hour;

  Emep() : LeafSystem("air"), reactions_(detail::emep_reactions()) {
    Eigen::VectorXd start = Eigen::VectorXd::Constant(66, 100.0);
    start.head(13).setConstant(1e7);
    start.head(5) << 1e9, 5e9, 5e9, 3.8e12, 3.5e13;
    start[13] = 5e11, start[37] = 1e-3;
    declare_continuous_state({.initial = std::move(start), .ode = &Emep::ode});
    declare_sparse_jacobian(entries(), &Emep::jacobian);
    declare_continuous_state_output("y");
    declare_default_mode(day);
    declare_discrete_state(Eigen::VectorXd::Zero(1));  // the begin of the day [s]
    std::vector<double> turns = jumps();
    std::erase_if(turns, [](double t) { return std::fmod(t, midnight) == 0.0; });
    declare_time_event(
        {.name = "sun",
         .update = [](const At& at, Next& next) { next.set_mode(at.mode == day ? night : day); },
         .times = std::move(turns)});
    declare_periodic_update([](const At& at, Next& next) { next.set_discrete_state({at.time}); },
                            midnight, midnight, "midnight");
    fix_constants();
  }

  /// Times [s] of the jumps within the published span, each sunset, midnight and sunrise.
  static std::vector<double> jumps() {
    std::vector<double> times;
    for (int n = 0; n < 4; ++n) {
      for (const double t : {sunset, midnight, midnight + sunrise})
        times.push_back(t + n * midnight);
    }
    return times;
  }

 private:
  using Rates = std::array<double, 237>;  // by their number; photolysis apart
  struct Now {
    Rates k;
    std::array<double, 17> light;
    double of(int rate) const { return rate < 0 ? nth(light, -rate) : nth(k, rate); }
  };

  void fix_constants() {
    const double t = detail::emep_temperature, air = detail::emep_air;
    constant_.fill(0.0);
    for (const auto& [rate, factor, kelvin] : detail::emep_constants)
      nth(constant_, rate) = factor * std::exp(kelvin / t);
    constant_[1] = 5.7e-34 * std::pow(t / 300.0, -2.8) * air * detail::emep_oxygen;
    constant_[5] = 9.6e-32 * std::pow(t / 300.0, -1.6) * air;
    constant_[7] = 2.0e-11 * std::exp(100.0 / t) * air;
    constant_[36] = 2.3e-13 * std::exp(600.0 / t) + air * 1.7e-33 * std::exp(1000.0 / t);
    emission_ = Eigen::VectorXd::Zero(66);
    double moles = 0.0;
    for (const auto& share : detail::emep_hydrocarbons) moles += share.fraction / share.weight;
    const double unit = detail::emep_emission / detail::emep_layer;
    for (const auto& share : detail::emep_hydrocarbons)
      emission_[share.substance - 1] = unit * share.fraction / share.weight / moles;
    for (const auto& [substance, multiple] : detail::emep_multiples)
      emission_[substance - 1] = unit * multiple;
  }
  /// Water [molecules/cm^3], by the pressure of saturation over a humidity of 43.5 to 89.5 %.
  static double water(double time_of_day) {
    const double t = detail::emep_temperature, zero = 273.16,
                 x = (597.3 - 0.57 * (t - zero)) * 18.0 / 1.986 * (1.0 / t - 1.0 / zero),
                 humidity = 23.0 * std::sin(2.43 - 7.93e-5 * time_of_day) + 66.5;
    return 6.1078 * std::exp(-x) * 10.0 / (1.38e-16 * t) * humidity;
  }
  /// 1 / cos of the zenith angle.
  static double secant(double time_of_day) {
    const double degree = std::numbers::pi / 180.0, latitude = 50.0 * degree,
                 declination = 23.5 * degree,
                 angle = (1.0 + time_of_day / (12.0 * hour)) * std::numbers::pi;
    return 1.0 / (std::cos(angle) * std::cos(latitude) * std::cos(declination) +
                  std::sin(latitude) * std::sin(declination));
  }
  Now rates(const At& at) const {
    Now now{constant_, {}};
    const double tod = at.time - at.z[0], h2o = water(tod), t = detail::emep_temperature;
    now.k[8] *= h2o;
    now.k[36] *= 1.0 + 1.4e-21 * h2o * std::exp(2200.0 / t);
    for (std::size_t i = 0; i < detail::emep_deposition.size(); ++i)
      now.k[47 + i] =
          detail::emep_deposition[i] * (at.mode == day ? 1.0 : 0.25) / detail::emep_layer;
    const double sec = at.mode == day ? secant(tod) : 0.0;
    for (std::size_t n = 1; n < now.light.size(); ++n) {
      const auto& [a, b] = detail::emep_light[n - 1];
      now.light[n] = at.mode == day ? a * std::exp(-b * sec) : detail::emep_darkness;
    }
    return now;
  }
  void ode(const At& at, VectorRef xdot) const {
    const Now now = rates(at);
    xdot = emission_;
    for (const auto& [rate, a, b, changes] : reactions_) {
      const double r = now.of(rate) * at.x[a - 1] * (b > 0 ? at.x[b - 1] : 1.0);
      for (const auto& [substance, amount] : changes) xdot[substance - 1] += amount * r;
    }
  }

  /// The entries, each once, and for each reaction and reactant the entries of its changes.
  std::vector<MatrixEntry> entries() {
    std::vector<MatrixEntry> all;
    std::map<std::pair<int, int>, Index> known;
    for (const auto& [rate, a, b, changes] : reactions_) {
      for (const int from : {a, b}) {
        for (const auto& change : changes) {
          if (from == 0) continue;
          const auto [place, fresh] = known.try_emplace({change.substance, from}, all.size());
          if (fresh) all.push_back({change.substance - 1, from - 1});
          places_.push_back(place->second);
        }
      }
    }
    return all;
  }
  void jacobian(const At& at, VectorRef out) const {
    const Now now = rates(at);
    out.setZero();
    auto place = places_.begin();
    for (const auto& [rate, a, b, changes] : reactions_) {
      const double k = now.of(rate), by_a = k * (b > 0 ? at.x[b - 1] : 1.0), by_b = k * at.x[a - 1];
      for (const auto& change : changes) out[*place++] += change.amount * by_a;
      if (b == 0) continue;
      for (const auto& change : changes) out[*place++] += change.amount * by_b;
    }
  }

  const std::vector<detail::EmepReaction>& reactions_;
  std::vector<Index> places_;
  Rates constant_;
  Eigen::VectorXd emission_;
};

struct EmepParameters {
  double t_end = 417600.0;  ///< [s] 20 h of the fifth day
};

/// Records "y" at the times of the reference; atol = 1e6 rtol. The growth: see hires.hpp.
inline Scene emep(const EmepParameters& with = {}) {
  const auto air = std::make_shared<const Emep>();
  Exact known = detail::emep_reference();
  known.events = {detail::firings("air.*", Emep::jumps())};
  return detail::with_rows_at_samples(
      {.name = "EMEP",
       .system = air,
       .context = air->create_context(),
       .span = {Emep::sunrise, with.t_end},
       .options = {.rtol = 1e-6, .atol = 1.0, .recorded_signals = {{"y", air->output(0)}}},
       .exact = detail::until(with.t_end, 417600.0, std::move(known)),
       .methods = {Method::bdf, Method::radau, Method::automatic},
       .growth = 5.6});
}

}  // namespace saltus::models
