// Histories: after each accepted step, leaves append to what they keep of the past of their inputs.
#pragma once

#include <algorithm>
#include <limits>

#include "saltus/simulation/detail/integration.hpp"

namespace saltus {

/// The one writer of discrete states outside of instants. A run without histories asks `any` and
/// nothing else.
class Histories {
 public:
  Histories(Machine& machine, const SimulatorOptions& options);

  bool any() const noexcept { return !machine_->plan().histories.empty(); }
  /// A run begins. If it continues another, that may have ended with an instant, which changed
  /// something or not.
  void begin(bool continues) { changed_ = !continues, continues_ = continues; }
  /// Something changed in an instant: the next step begins a new stretch.
  void changed() { changed_ = true; }
  /// [s] The latest time at which a step from `from` may end.
  double longest_end(double from) const { return from + longest_step_; }
  /// A step was accepted. Throws what a function of the model throws.
  void add(double from, double to, Integration& integration);

 private:
  void append(int leaf, double from, double to, Integration& integration);

  Machine* machine_;
  double rtol_, atol_;
  double longest_step_ = std::numeric_limits<double>::infinity();
  bool changed_ = true;
  bool continues_ = false;  // the next step is the first one after another run
};

}  // namespace saltus
