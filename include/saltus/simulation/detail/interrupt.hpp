// Interrupt: when a run asks its user whether to stop.
#pragma once

#include <chrono>
#include <cstdint>

#include "saltus/simulation/options.hpp"

namespace saltus {

/// Looks at the clock at every 16th minor step, and asks every 20 ms: the question may cost more
/// than many steps, as that for the signals of Python.
class Interrupt {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Interrupt(const SimulatorOptions& options) : options_(&options) {}

  /// A run begins.
  void begin() { ticks_ = 0; }
  /// The run goes on; `now` counts as the last question.
  void go_on(Clock::time_point now) { asked_ = now; }
  /// After a minor step: whether the user asks the run to stop. `count` is called before the
  /// question, so that the user sees the present counts.
  template <class Count>
  bool after_step(Count count) {
    return (++ticks_ & 15) == 0 && options_->interrupt && due() && (count(), options_->interrupt());
  }

 private:
  bool due() {
    const auto now = Clock::now();
    if (now - asked_ < std::chrono::milliseconds(20)) return false;
    asked_ = now;
    return true;
  }

  const SimulatorOptions* options_;
  std::int64_t ticks_ = 0;  // minor steps
  Clock::time_point asked_{};
};

}  // namespace saltus
