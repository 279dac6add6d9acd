// The rate of a value: the fastest rate of the values that it reads and of its inputs.
#pragma once

#include <algorithm>

#include "saltus/model/port.hpp"

namespace saltus {

enum class Rate {
  constant,    ///< once, at run start
  held,        ///< at instants
  continuous,  ///< in the right-hand side, the guards or the taps that need it
};

/// Whether a value is held although the values that it reads may move. It follows them at its
/// leaf's time events only.
constexpr bool samples(Reads reads) { return has(reads, Reads::schedule); }

/// The rate of a value by the values it reads, apart from inputs and relations.
constexpr Rate own_rate(Reads reads, bool has_x, bool has_z, bool has_modes) {
  if (has(reads, Reads::time)) return Rate::continuous;
  if (samples(reads)) return Rate::held;
  if (has_x && has(reads, Reads::continuous_state)) return Rate::continuous;
  const bool stepwise = has(reads, Reads::outside) ||
                        (has_z && has(reads, Reads::discrete_state)) ||
                        (has_modes && has(reads, Reads::mode));
  return stepwise ? Rate::held : Rate::constant;
}

/// Whether a value varies while all states are kept, as a Sine does. A called function that does not
/// say what it reads may do so.
enum class FollowsTime : signed char { no, perhaps, yes };

constexpr Rate faster(Rate a, Rate b) { return std::max(a, b); }

constexpr const char* to_string(Rate rate) {
  return rate == Rate::constant ? "constant" : rate == Rate::held ? "held" : "continuous";
}

}  // namespace saltus
