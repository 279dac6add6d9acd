// Fixed length: the vectors whose operations are unrolled.
#pragma once

#include "saltus/base/ids.hpp"
#include "saltus/solver/detail/cvode_thresholds.hpp"

namespace saltus {

/// Whether the vector operations of CVODE are unrolled for n states. Those of more states are the
/// general operations of SUNDIALS.
constexpr bool has_fixed_length(Index n) { return n >= 1 && n <= thresholds::small_vector; }

}  // namespace saltus
