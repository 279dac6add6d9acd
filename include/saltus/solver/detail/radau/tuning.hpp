// The tuning numbers of the Radau methods: name, unit, and derivation or source.
#pragma once

namespace saltus::radau::tuning {

// --- the error of a step: allowed_estimate.hpp

/// [tolerances] Error of a fast part that a step may leave. Two steps of this size each stay within
/// `dense_room`, and one tolerance costs 3 % more calls on the stiff shelf.
inline constexpr double fast_error = 2.0;
/// [1] From this part of its length on, a second try of a step shows too little of what its error
/// depends on: the estimate shrinks by a factor of 0.86 at most then, for three stages.
inline constexpr double alike_tries = 0.95;

}  // namespace saltus::radau::tuning
