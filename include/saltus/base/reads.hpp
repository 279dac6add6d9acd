// Reads: the kinds of values that an output or a guard depends on.
#pragma once

namespace saltus {

/// The kinds of values that a computation depends on. They decide how often it runs: see `Rate`.
enum class Reads : unsigned {
  parameters = 0,  ///< nothing that changes during a run
  time = 1,
  continuous_state = 2,
  discrete_state = 4,
  mode = 8,
  inputs = 16,
  relations = 32,
  /// The value depends on the time, but changes at the leaf's own time events only. If it reads
  /// inputs or a continuous state too, it samples them at those events, and is held in between.
  schedule = 64,
  everything = 63,
  /// Values outside of the system that reset maps and updates write, such as a variable that several
  /// functions share. They change at instants only, and the writer says so: see
  /// Next::note_write_outside.
  outside = 128,
};
constexpr Reads operator|(Reads a, Reads b) {
  return static_cast<Reads>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Reads set, Reads one) {
  return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

}  // namespace saltus
