// y = start_value for t < step_time, end_value from step_time on.
// out: elementwise of both values. Parameters "start_value", "end_value". Held; changes at an exact
// time event.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct StepOptions {
  Value start_value = 0.0;
  Value end_value = 1.0;
  double step_time = 1.0;  ///< [s] structure, not a parameter: time events are known before a run
};

class Step final : public LeafSystem {
 public:
  using Options = StepOptions;

  explicit Step(std::string name, const Options& options = {});

 private:
  void value(const At& at, VectorRef out) const;

  double step_time_;  // [s]
  ParameterIndex start_, end_;
};

}  // namespace saltus
