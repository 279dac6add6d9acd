// Standstill: a run that is begun at a context, and goes nowhere.
#pragma once

#include <memory>

#include "saltus/plan/compile.hpp"
#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

/// The memory of a run at its first instant, before anything happens there: relations have the
/// truths that their guards have, or that the run which ended at the context held.
class Standstill {
 public:
  explicit Standstill(std::shared_ptr<const Plan> plan)
      : machine_(std::move(plan)),
        guards_(machine_.plan()),
        instant_(machine_, guards_, options_, results_) {}

  /// Takes the values of a context. Throws ModelError for a context of another system.
  void begin(const Context& context) {
    require_context_of(machine_.plan(), context);
    machine_.load(context);
    time_ = context.time();
    const Continuation* earlier = context.continuation();
    if (earlier != nullptr && instant_.fits(*earlier))
      instant_.resume(time_, nullptr, *earlier, 0.0);
    else
      instant_.begin(time_, nullptr);
  }

  Machine& machine() noexcept { return machine_; }
  const GuardSet& guards() const noexcept { return guards_; }
  double time() const noexcept { return time_; }

 private:
  SimulatorOptions options_;
  Results results_;
  Machine machine_;
  GuardSet guards_;
  Instant instant_;
  double time_ = 0.0;
};

}  // namespace saltus
