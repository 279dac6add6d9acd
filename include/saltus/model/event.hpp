// What a leaf declares about its events: zero crossings, relations, edges, time events.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/base/callback.hpp"
#include "saltus/base/error.hpp"
#include "saltus/model/port.hpp"

namespace saltus {

/// In which direction a guard g fires. `crosses_zero` is either of the two after it.
enum class Direction {
  none,
  crosses_zero,
  positive_then_non_positive,
  negative_then_non_negative,
  edge_detection
};

inline constexpr std::array<std::pair<std::string_view, Direction>, 5> direction_names{{
    {"none", Direction::none},
    {"crosses_zero", Direction::crosses_zero},
    {"positive_then_non_positive", Direction::positive_then_non_positive},
    {"negative_then_non_negative", Direction::negative_then_non_negative},
    {"edge_detection", Direction::edge_detection},
}};

/// The direction of that name; a ModelError with the nearest name if there is none.
inline Direction direction_from(std::string_view name) {
  std::vector<std::string> known;
  for (const auto& [text_form, direction] : direction_names) {
    if (text_form == name) return direction;
    known.emplace_back(text_form);
  }
  throw ModelError(text("unknown direction '", name, "'", known_names(name, known)));
}

inline std::string_view to_string(Direction direction) {
  return direction_names[static_cast<std::size_t>(direction)].first;
}

/// Whether a guard armed on `side` (+1, -1) fires on reaching the sign `now` (-1, 0, +1).
/// Signs are compared, never multiplied: a guard scaled by 1e-200 works.
constexpr bool fires(Direction direction, int side, int now) {
  const bool falls = side > 0 && now <= 0;
  const bool rises = side < 0 && now >= 0;
  switch (direction) {
    case Direction::positive_then_non_positive:
      return falls;
    case Direction::negative_then_non_negative:
      return rises;
    case Direction::crosses_zero:
      return falls || rises;
    case Direction::edge_detection:
      return side != now;
    case Direction::none:
      return false;
  }
  return false;
}

/// A guard and what happens when it fires. Without reset map, mode change and `terminal` it is a
/// monitor: its crossings are located and logged, and the trajectory is the same to the last bit as
/// without it.
struct ZeroCrossing {
  std::string name = {};
  VectorFunction guard = {};  ///< g(t, x, z, m, u, p), a number
  ResetMap reset_map = {};    ///< x+ from x-; optional
  Direction direction = Direction::crosses_zero;
  std::optional<int> start_mode = {};           ///< seen in this mode only
  std::optional<int> end_mode = {};             ///< mode after it fired
  bool terminal = false;                        ///< ends the run, after its reset map
  std::optional<double> zeno_tolerance = {};    ///< [s] overrides SimulatorOptions::zeno_tolerance
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the guard reads; all if not said
};

/// A boolean with a smooth guard behind it: true while g > 0. Held between instants, so that the
/// solver sees neither the jump nor the kink it stands for.
struct Relation {
  std::string name = {};
  VectorFunction guard = {};        ///< as many numbers as the relation has entries
  bool true_at_zero = false;        ///< what g == 0 means where no side is known yet
  std::optional<Index> size = 1;    ///< number of entries; empty: that of the widest input
  Reads reads = Reads::everything;  ///< what the guard reads
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the guard reads; all if not said
};

enum class Edge { rising, falling, either };

/// A reset that follows an edge of a held signal. With `holds`, the leaf comes under the Zeno
/// monitor and a hold ends when the signal falls back.
struct EdgeReset {
  std::string name = {};
  int input = 0;  ///< the input that is watched, read as boolean: u != 0
  Edge edge = Edge::rising;
  ResetMap reset_map = {};
  std::optional<double> zeno_tolerance = {};    ///< [s] overrides SimulatorOptions::zeno_tolerance
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the reset map reads; all if not said
};

/// An exact stop at `offset + k period`, k = 0, 1, ...; once at `offset` if the period is infinite.
/// Counted by integers, so that 1000 periods of 1/3 s are 1000 ticks.
struct TimeEvent {
  std::string name = {};
  ResetMap update = {};  ///< optional: without it held outputs are read again
  double period = std::numeric_limits<double>::infinity();  ///< [s]
  double offset = 0.0;                                      ///< [s]
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the update reads; all if not said
};

}  // namespace saltus
