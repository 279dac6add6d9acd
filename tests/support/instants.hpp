// Instants without a solver: a test chooses the time, the state, and the guard that fired.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "saltus/simulation/detail/instant.hpp"
#include "support/leaves.hpp"

namespace support {

/// The parts of a run except its solver and its calendar.
struct Instants {
  explicit Instants(std::shared_ptr<const saltus::System> of, saltus::SimulatorOptions with = {})
      : system(std::move(of)),
        options(std::move(with)),
        machine(saltus::compile(*system)),
        guards(machine.plan()),
        instant(machine, guards, options, results) {
    machine.load(system->create_context());
  }

  /// The run begins in this state.
  saltus::Outcome begin(double t, const Eigen::VectorXd& x) {
    machine.x = x;
    instant.begin(t, nullptr);
    return instant.run(t, {}, longest, true);
  }
  /// Guard k fires in this state, coming from the side `from`.
  saltus::Outcome fire(double t, const Eigen::VectorXd& x, std::size_t k, int from) {
    return fire(t, x, {{k, from}});
  }
  saltus::Outcome fire(double t, const Eigen::VectorXd& x,
                       const std::vector<std::pair<std::size_t, int>>& firings) {
    machine.x = x;
    machine.guards(t, x.data(), guards.g.data());
    guards.fired_at_root.clear();
    for (const auto& [k, from] : firings)
      guards.fired_at_root.push_back({static_cast<int>(k), from, guards[k].at_zero()});
    return instant.run(t, {}, longest);
  }
  /// The time event of this number in the plan is due in this state.
  saltus::Outcome tick(double t, const Eigen::VectorXd& x, int event) {
    machine.x = x;
    return instant.run(t, {event}, longest);
  }

  /// Whether all states rest.
  bool at_rest() const {
    for (saltus::Index i = 0; i < machine.x.size(); ++i) {
      if (!const_cast<saltus::Machine&>(machine).resting().rests(i)) return false;
    }
    return true;
  }
  int count(saltus::EventKind kind) const { return support::count(results.events, kind); }

  std::shared_ptr<const saltus::System> system;
  saltus::SimulatorOptions options;
  saltus::Machine machine;
  saltus::GuardSet guards;
  saltus::Results results;
  saltus::Instant instant;
  double longest = 10.0;  // [s]
};

/// A ball over a floor at the height z[0], under g = 10 m/s^2. Its time events move the floor by
/// `step`, kick the ball to the speed `kick`, and count in z[1].
struct FloorBall {
  double e = 0.5, step = -0.5, kick = 3.0;
  saltus::OnZeno on_zeno = {};
  std::vector<std::vector<int>> holds = {};
  std::optional<double> zeno_tolerance = {};

  static constexpr int move = 0, push = 1, count = 2;

  std::shared_ptr<Leaf> make() const {
    return std::make_shared<Leaf>("ball", [this](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, 0.0}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -10.0; },
           .reads = saltus::Reads::continuous_state});
      l.declare_discrete_state(vec({0.0, 0.0}));
      const double restitution = e;
      l.declare_zero_crossing({.name = "bounce",
                               .guard = [](const At& at) { return at.x[0] - at.z[0]; },
                               .reset_map =
                                   [restitution](const At& at, Next& next) {
                                     next.set_continuous_state({at.z[0], -restitution * at.x[1]});
                                   },
                               .direction = saltus::Direction::positive_then_non_positive,
                               .on_zeno = on_zeno,
                               .zeno_tolerance = zeno_tolerance,
                               .holds = holds});
      const double by = step, speed = kick;
      l.declare_one_shot(
          1.0, [by](const At& at, Next& next) { next.set_discrete_state({at.z[0] + by, at.z[1]}); },
          "move");
      l.declare_one_shot(
          2.0, [speed](const At& at, Next& next) { next.set_continuous_state({at.x[0], speed}); },
          "push");
      l.declare_one_shot(
          3.0, [](const At& at, Next& next) { next.set_discrete_state({at.z[0], at.z[1] + 1.0}); },
          "count");
    });
  }
};

}  // namespace support
