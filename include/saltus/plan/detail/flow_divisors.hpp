// FlowDivisors: the divisors in the derivatives of a plan, kept with the plan.
#pragma once

#include <memory>
#include <optional>

#include "saltus/plan/plan.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus {

/// The divisors of all derivatives that may change their sign, over the variables of a FlowGraph.
struct FlowDivisors {
  std::optional<tape::Tape> values = {};  ///< none: there are no such divisors, or no expressions
};

/// The divisors that the plan keeps; the first call finds them.
std::shared_ptr<const FlowDivisors> flow_divisors(const Plan& plan);

}  // namespace saltus
