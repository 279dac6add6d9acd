// Ballistic: the exact motion of a ball that bounces on a floor, flight by flight. The floor may
// drop once.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "saltus/base/error.hpp"
#include "saltus/report/exact.hpp"

namespace saltus::models {

/// A ball thrown from y0 with v0 over a floor at `floor`; from `drop_time` on the floor is at
/// `dropped`, which is lower.
struct BallisticProblem {
  double g = 9.81;                    ///< [m/s^2] > 0
  double e = 1.0;                     ///< coefficient of restitution, 0 <= e <= 1
  double y0 = 10.0;                   ///< [m]
  double v0 = 0.0;                    ///< [m/s]
  double floor = 0.0, dropped = 0.0;  ///< [m]
  double drop_time = std::numeric_limits<double>::infinity();  ///< [s]
};

/// A flight from (y, v) at `begin` is y + v d - g d^2 / 2. It ends on the floor after d = (v + s) /
/// g, with the speed s = sqrt(v^2 + 2 g (y - floor)), and the next one begins with e s. Flights
/// from the floor last 2 v/g e^k: they accumulate at begin + 2 v / (g (1 - e)), and there the ball
/// rests until the floor drops from under it. A drop in flight changes only the end of the flight.
/// The numbers are long double, so their own rounding does not show.
class Ballistic {
 public:
  Ballistic(const BallisticProblem& problem, double t_end);

  const EventTimes& bounces() const noexcept { return bounces_; }
  /// (y, v) at time t on a branch. The branch is continued if t is outside of it.
  Eigen::VectorXd state(double t, const Branch& branch) const;
  /// The branch at time t; exactly at a bounce, the branch after it.
  Branch branch_at(double t) const;

 private:
  using Real = long double;
  struct Flight {
    Real begin, y, v;
  };
  using Flights = std::vector<Flight>;  // the flights of one series, flight n after n bounces

  bool fly();
  Real floor() const { return dropped_ ? problem_.dropped : problem_.floor; }
  Real impact_speed(const Flight& f) const {
    return std::sqrt(f.v * f.v + 2 * Real(problem_.g) * (f.y - floor()));
  }

  BallisticProblem problem_;
  double t_end_;
  bool dropped_ = false;
  std::vector<Flights> flights_;
  EventTimes bounces_;
};

inline Ballistic::Ballistic(const BallisticProblem& problem, double t_end)
    : problem_(problem), t_end_(t_end) {
  const auto insist = [](bool good, std::string_view what, double found) {
    if (!good) throw ModelError(text("bouncing ball: expected ", what, ", found ", found));
  };
  insist(problem.g > 0.0 && std::isfinite(problem.g), "g > 0 m/s^2", problem.g);
  insist(problem.e >= 0.0 && problem.e <= 1.0, "a coefficient of restitution 0 <= e <= 1",
         problem.e);
  insist(problem.y0 >= problem.floor, "y0 at or above the floor", problem.y0);
  insist(problem.dropped <= problem.floor || !std::isfinite(problem.drop_time),
         "a floor that drops", problem.dropped);
  flights_.push_back({{0, problem.y0, problem.v0}});
  bounces_.series.emplace_back();
  while (fly()) {
    EventSeries& series = bounces_.series.back();
    if (dropped_ || !(problem.drop_time < t_end) || !(problem.dropped < problem.floor)) return;
    series.release = problem.drop_time;
    dropped_ = true;
    flights_.push_back({{problem.drop_time, problem.floor, 0}});
    bounces_.series.emplace_back();
  }
}

/// Adds the flights of one series; true if the ball comes to rest before the end of time.
inline bool Ballistic::fly() {
  const Real g = problem_.g, e = problem_.e;
  Flights& flights = flights_.back();
  EventSeries& series = bounces_.series.back();
  for (;;) {
    const Flight f = flights.back();
    // Flights from the floor shorter than 1e-18 s are the rest of the series. A ball that starts on
    // the floor touches it first.
    if (flights.size() > 1 && 2 * f.v < 1e-18L * g) {
      const Real rest = e < 1 ? f.begin + 2 * f.v / (g * (1 - e)) : f.begin;
      if (rest <= t_end_) series.accumulation = static_cast<double>(rest);
      return rest <= t_end_;
    }
    const Real speed = impact_speed(f), impact = f.begin + (f.v + speed) / g;
    if (!dropped_ && impact > problem_.drop_time) {
      dropped_ = true;
      continue;
    }
    if (impact > t_end_) return false;
    if (flights.size() > 1'000'000)
      throw ModelError(
          text("bouncing ball: more than a million bounces before t = ", t_end_, " s"));
    series.times.push_back(static_cast<double>(impact));
    flights.push_back({impact, floor(), e * speed});
  }
}

inline Eigen::VectorXd Ballistic::state(double t, const Branch& branch) const {
  const std::size_t series = std::min(branch.series, flights_.size() - 1);
  const Flights& flights = flights_[series];
  if (branch.rest) return Eigen::Vector2d(static_cast<double>(flights.back().y), 0.0);
  const Flight& f = flights[std::min(branch.events, flights.size() - 1)];
  const Real d = t - f.begin, g = problem_.g;
  return Eigen::Vector2d(static_cast<double>(f.y + d * (f.v - g * d / 2)),
                         static_cast<double>(f.v - g * d));
}

inline Branch Ballistic::branch_at(double t) const {
  std::size_t series = 0;
  while (bounces_.series[series].release <= t) ++series;
  const EventSeries& here = bounces_.series[series];
  if (here.accumulation <= t) return {series, 0, true};
  const auto next = std::ranges::upper_bound(here.times, t);
  return {series, static_cast<std::size_t>(next - here.times.begin()), false};
}

/// The known answer for a scene that records (y, v) and whose bounces are the events of `guard`.
inline Exact ballistic_answer(const BallisticProblem& problem, double t_end, std::string guard) {
  const auto motion = std::make_shared<const Ballistic>(problem, t_end);
  EventTimes bounces = motion->bounces();
  bounces.guard = std::move(guard);
  return {.provenance = "closed form: parabolas, impact times in extended precision",
          .events = {std::move(bounces)},
          .state = [motion](double t, const Branch& branch) { return motion->state(t, branch); }};
}

}  // namespace saltus::models
