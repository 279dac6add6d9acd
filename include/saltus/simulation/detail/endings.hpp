// Endings: the reasons that end a run before its end.
#pragma once

#include <optional>
#include <string>

#include "saltus/simulation/detail/chattering.hpp"
#include "saltus/simulation/detail/crawl.hpp"
#include "saltus/simulation/detail/interrupt.hpp"
#include "saltus/simulation/detail/journal.hpp"
#include "saltus/simulation/detail/poles.hpp"

namespace saltus {

/// Looks after each step and each instant whether the run has to end: at a pole that a step passed,
/// on a slide along a jump of the derivative, where events follow each other without end, or
/// because the user asks for it. It says why, and leaves the run as it is.
class Endings {
 public:
  struct Ending {
    Status status;
    std::string block = {};  ///< path
    std::string message;
  };

  Endings(Machine& machine, const SimulatorOptions& options);

  /// A run begins at t.
  void begin(double t);
  /// The run goes on; `now` counts as the last question to the user.
  void go_on(Interrupt::Clock::time_point now) { interrupt_.go_on(now); }

  /// A step leaves t [s] and the state x.
  void depart(double t, const Eigen::VectorXd& x) {
    if (poles_) poles_->depart(t, x);
  }
  /// Whether the step between these times [s] has passed a pole.
  bool passed_pole(double from, double to, Integration& integration) {
    return poles_ && integration.started() && poles_->passed(from, to, integration);
  }
  /// The error about the pole that was passed.
  SimulationError pole_error(double from, double to) const;
  /// The state that the step past a pole left.
  const Eigen::VectorXd& departed_from() const { return poles_->departed_from(); }

  /// After a step to t: whether the solution slides along a jump of its derivative.
  std::optional<Ending> after_step(double t, double length_of_run, const Integration& integration) {
    if (!integration.started() || !crawl_.looks(t, length_of_run)) return {};
    return slides(t, integration);
  }
  /// Whether the user asks the run at t [s] to stop. `count` is called before the question.
  template <class Count>
  std::optional<Ending> interrupted(double t, Count count) {
    if (!interrupt_.after_step(count)) return {};
    return Ending{.status = Status::interrupted, .message = text("t = ", t, " s: interrupted")};
  }

  /// Before an instant: whether no state has moved by its tolerance since the last root.
  bool idle() { return chattering_.idle(machine_->x); }
  /// After an instant; `idle` is the answer before it.
  std::optional<Ending> after_instant(const Outcome& outcome, const Chattering::Seen& seen,
                                      bool idle, const Journal& journal);

 private:
  std::optional<Ending> slides(double t, const Integration& integration);
  Ending chattering(const Chattering::Seen& seen, const EventName& name) const;
  const PlanLeaf& leaf_of(Index state) const;

  Machine* machine_;
  Chattering chattering_;
  Crawl crawl_;
  std::optional<Poles> poles_;  // where tolerances are loose
  Interrupt interrupt_;
};

}  // namespace saltus
