// The ball of the benchmark, one right-hand side for all programs: dy/dt = v, dv/dt = -g - k v |v|.
#pragma once

#include <array>
#include <cmath>
#include <saltus/saltus.hpp>
#include <saltus/solver/inlined.hpp>
#include <vector>

namespace bench {

struct Ball {
  double g = 9.81;  ///< [m/s^2]
  double e = 0.9;   ///< coefficient of restitution
  /// [1/m] quadratic drag; with 0 flights are parabolas, on which every method is exact.
  double k = 0.0;
  double y0 = 10.0;  ///< [m]
  double t_end = 12.0;

  void derivative(const double* x, double* xdot) const {
    xdot[0] = x[1];
    xdot[1] = -g - k * x[1] * std::abs(x[1]);
  }
};

/// The result of a run, enough to see whether two runs agree.
struct Outcome {
  double y = 0.0, v = 0.0;
  long steps = 0, right_hand_side_calls = 0, guard_calls = 0;
  std::array<double, 64> times = {};  ///< [s] of the bounces
  std::size_t bounces = 0;

  void bounced(double t) {
    if (bounces < times.size()) times[bounces] = t;
    ++bounces;
  }
};

/// The same ball for Saltus, with its right-hand side inlined into the steps or called.
class BallLeaf final : public saltus::LeafSystem {
 public:
  explicit BallLeaf(const Ball& ball, bool inlined = true) : LeafSystem("ball"), ball_(ball) {
    if (inlined)
      declare_continuous_state(2, saltus::inlined<2>(saltus::method<&BallLeaf::ode>));
    else
      declare_continuous_state(2, &BallLeaf::ode);
    declare_zero_crossing({.name = "bounce",
                           .guard = saltus::method<&BallLeaf::height>,
                           .reset_map = saltus::method<&BallLeaf::bounce>,
                           .direction = saltus::Direction::positive_then_non_positive});
  }

 private:
  void ode(const At& at, VectorRef xdot) const { ball_.derivative(at.x.data(), xdot.data()); }
  double height(const At& at) const { return at.x[0]; }
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({std::abs(at.x[0]), -ball_.e * at.x[1]});
  }

  Ball ball_;
};

/// One Simulator, used repeatedly. It records only the event log, and that on request.
class SaltusRun {
 public:
  SaltusRun(const Ball& ball, const saltus::SimulatorOptions& options, bool inlined = true)
      : ball_(ball),
        leaf_(ball, inlined),
        start_(leaf_.create_context().with_continuous_state(Eigen::Vector2d(ball.y0, 0.0))),
        simulator_(leaf_, options) {}

  void operator()() {
    simulator_.initialize(start_);
    simulator_.advance_to(ball_.t_end);
  }

  Outcome outcome() const {
    const saltus::Results& results = simulator_.results();
    const saltus::Statistics& s = results.statistics;
    Outcome out{.y = results.context.continuous_state()[0],
                .v = results.context.continuous_state()[1],
                .steps = s.steps,
                .right_hand_side_calls = s.right_hand_side_calls,
                .guard_calls = s.guard_calls};
    for (const double t : results.events.times("bounce")) out.bounced(t);
    return out;
  }

 private:
  Ball ball_;
  BallLeaf leaf_;
  saltus::Context start_;
  saltus::Simulator simulator_;
};

}  // namespace bench
