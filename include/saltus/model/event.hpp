// The declarations of a leaf about its events: zero crossings, relations, edges, time events.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/base/callback.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "saltus/model/number_of.hpp"
#include "saltus/model/port.hpp"

namespace saltus {

/// The direction in which a guard g fires. `crosses_zero` means either of the two after it.
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

namespace detail {

/// The value with this name in a table; a ModelError with the nearest name if the table has none.
template <class Table>
auto value_of(const Table& table, std::string_view what, std::string_view name) {
  std::vector<std::string> known;
  for (const auto& [text_form, value] : table) {
    if (text_form == name) return value;
    known.emplace_back(text_form);
  }
  throw ModelError(text("unknown ", what, " '", name, "'", known_names(name, known)));
}

}  // namespace detail

/// The direction with this name; a ModelError with the nearest name if there is none.
Direction direction_from(std::string_view name);

inline std::string_view to_string(Direction direction) {
  return nth(direction_names, direction).first;
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

/// How a guard is armed if it is exactly at zero, or already on its firing side, when a run starts
/// or its mode is entered.
enum class AtStart {
  automatic,  ///< at zero and headed for its firing side it fires at once if it has a reset map or
              ///< a mode change (contact), otherwise it waits; on its firing side it waits until it
              ///< has left that side
  ignore,     ///< it waits, in either case
  fire,       ///< it fires at once, in either case
  error       ///< a SimulationError, in either case
};

inline constexpr std::array<std::pair<std::string_view, AtStart>, 4> at_start_names{{
    {"auto", AtStart::automatic},
    {"ignore", AtStart::ignore},
    {"fire", AtStart::fire},
    {"error", AtStart::error},
}};

/// The value with this name; a ModelError with the nearest name if there is none.
AtStart at_start_from(std::string_view name);

/// How a guard continues at its Zeno point, where its firings accumulate or no time can pass
/// between them.
class OnZeno {
 public:
  enum class Kind { hold, stop, error, mode };

  static constexpr OnZeno hold() { return {Kind::hold, 0}; }    ///< rest there, until released
  static constexpr OnZeno stop() { return {Kind::stop, 0}; }    ///< end the run: zeno_stop
  static constexpr OnZeno error() { return {Kind::error, 0}; }  ///< a SimulationError
  /// Continue in this mode of the leaf, from the accumulation state.
  static constexpr OnZeno enter(int mode) { return {Kind::mode, mode}; }

  constexpr OnZeno() = default;
  constexpr Kind kind() const noexcept { return kind_; }
  constexpr int mode() const noexcept { return mode_; }

 private:
  constexpr OnZeno(Kind kind, int mode) : kind_(kind), mode_(mode) {}
  Kind kind_ = Kind::hold;
  int mode_ = 0;
};

/// The states of its leaf that a zero crossing touches.
struct Touches {
  std::vector<std::vector<int>> reads = {};  ///< entries of x that each guard reads
  std::vector<int> writes = {};              ///< entries of x that the reset map changes
  bool writes_discrete_state = true, writes_mode = true;  ///< by the reset map

  /// The entries that one of the guards reads or the reset map changes, in ascending order.
  std::vector<int> of_guard(int entry) const;
};

/// A guard and its effect. Without reset map, mode change and `terminal` it is a monitor: its
/// crossings are located and logged, and the trajectory has the same bits as without it. With
/// `size` n it is n guards that one call computes. Each fires on its own, and its reset map reads
/// the index of the guard that fired from `At::entry`.
///
/// With any of the members from `delay` on it is *queued*, as the events of SBML (Level 3 Version
/// 2, section 4.11) are: its firing is a trigger. The trigger schedules an execution, and the
/// execution applies the reset map and the mode. Executions that are due at one time follow each
/// other, the one of highest priority first. A queued zero crossing has an effect, is not terminal
/// and has no Zeno monitor.
struct ZeroCrossing {
  std::string name = {};
  VectorFunction guard = {};  ///< g(t, x, z, m, u, p), `size` numbers
  ResetMap reset_map = {};    ///< x+ from x-; optional
  Direction direction = Direction::crosses_zero;
  std::optional<int> start_mode = {};  ///< seen in this mode only
  std::optional<int> end_mode = {};    ///< mode after it fired
  bool terminal = false;               ///< ends the run, after its reset map
  int max_count = 1;  ///< of a terminal event: it ends the run when it fires this often
  Index size = 1;     ///< number of guards
  AtStart at_start = AtStart::automatic;      ///< at zero, or beyond it, when integration begins
  OnZeno on_zeno = OnZeno::hold();            ///< how it continues at its Zeno points
  std::optional<double> zeno_tolerance = {};  ///< [s] overrides SimulatorOptions::zeno_tolerance
  /// The entries of the leaf's continuous state that rest on a hold, one list for each guard. If
  /// not given, the entries that the guard and the effect touch rest. All entries rest if `touches`
  /// is not given either, or if the effect writes a discrete state or a mode that the derivatives
  /// read.
  std::vector<std::vector<int>> holds = {};
  std::optional<Touches> touches = {};          ///< known from the tapes of guard and reset map
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the guard reads; all if not given
  Formula formula = {};                         ///< in place of guard: a plan may fuse it
  DerivativesFunction guard_derivatives = {};   ///< of the guard, see ContinuousState::derivatives
  /// Of the reset map, also of one that Python traces: the rows are x+, then z+.
  DerivativesFunction reset_derivatives = {};

  /// [s] The time from the trigger to the execution, >= 0. It is evaluated at the trigger, with the
  /// values that the reset map would see. If not given, it is 0.
  std::optional<NumberOf> delay = {};
  /// The priority is evaluated before each execution of an instant, and the highest comes first.
  /// Executions of equal priority come in a random order, by SimulatorOptions::event_seed. An
  /// execution without a priority comes after all that have one.
  std::optional<NumberOf> priority = {};
  /// If false, a guard that goes back to its armed side cancels the execution; this needs a guard
  /// with one direction. If not given, it is true.
  std::optional<bool> persistent = {};
  /// Whether the guard counts as on its firing side before the start. If false, it fires at the
  /// start if it is on that side, or at zero. If not given, `at_start` decides. This needs a guard
  /// with one direction.
  std::optional<bool> initial_value = {};
  /// If true, the reset map is computed at the trigger, and the entries of states that it changes
  /// are written at the execution. If not given, it is false.
  std::optional<bool> use_values_from_trigger_time = {};
  /// If true, the reset map is not run in a pass in which an earlier event of the leaf has changed its
  /// discrete state or its mode: of several transitions of a state machine that are due at one time one
  /// is taken. The event is logged all the same.
  bool yields = false;
  /// If true, and updates are due at the time at which it fires, its reset map runs in the pass after
  /// them, with what they set off: so the priorities of a state machine decide between a transition that is
  /// due by itself and a trigger that an update moves.
  bool follows_updates = false;

  /// Whether its firing writes a state or a mode.
  bool has_effect() const { return reset_map || end_mode; }
  bool is_queued() const {
    return delay || priority || persistent || initial_value || use_values_from_trigger_time;
  }
  /// Whether a guard that goes back cancels its execution.
  bool is_cancelled_on_return() const { return !persistent.value_or(true); }
  /// How its guard is armed if it begins at zero or beyond zero, at the start of a run or where its
  /// mode is entered.
  AtStart wish(bool at_start_of_run) const;
  /// The error in the members of the queue, in words; empty if there is none.
  std::string queue_fault() const;
};

/// A boolean that a smooth guard decides: true while g > 0. It is held between instants, so the
/// solver sees neither its jump nor a kink.
struct Relation {
  std::string name = {};
  VectorFunction guard = {};        ///< as many numbers as the relation has entries
  bool true_at_zero = false;        ///< the truth for g == 0 while no side is known
  std::optional<Index> size = 1;    ///< number of entries; empty: that of the widest input
  Reads reads = Reads::everything;  ///< the values that the guard reads
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the guard reads; all if not given
  Formula formula = {};                         ///< in place of guard: a plan may fuse it
};

enum class Edge { rising, falling, either };

/// The period of an update that runs at each trigger of a triggered part of a diagram.
inline constexpr double inherited_period = -1.0;

/// A reset that follows an edge of a held signal. With `holds`, the leaf has a Zeno monitor, and a
/// hold ends when the signal falls back.
struct EdgeReset {
  std::string name = {};
  int input = 0;  ///< the input to watch, read as a boolean: u != 0
  Edge edge = Edge::rising;
  ResetMap reset_map = {};
  OnZeno on_zeno = OnZeno::hold();              ///< how it continues at its Zeno points
  std::optional<double> zeno_tolerance = {};    ///< [s] overrides SimulatorOptions::zeno_tolerance
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the reset map reads; all if not
                                                ///< given
  bool before_updates = false;  ///< it comes before the leaf's updates of the same instant
  /// It reads its inputs as they were before the instant: their limits from the left.
  bool reads_before = false;
};

/// An exact stop at `offset + k period`, k = 0, 1, ...; a single stop at `offset` if the period is
/// infinite; or a stop at each of `times`. Ticks are counted by integers, so 1000 periods of 1/3 s
/// are 1000 ticks.
struct TimeEvent {
  std::string name = {};
  ResetMap update = {};  ///< optional: without it held outputs are evaluated again
  double period = std::numeric_limits<double>::infinity();  ///< [s]
  double offset = 0.0;                                      ///< [s]
  std::optional<std::vector<int>> inputs = {};  ///< the inputs the update reads; all if not given
  /// Whether the edges of a control signal are its ticks, in place of period and offset: see
  /// DiagramBuilder::execute.
  bool inherited = false;
  /// [s] Increasing times, in place of period and offset.
  std::optional<std::vector<double>> times = {};
  double end = std::numeric_limits<double>::infinity();  ///< [s] no tick is later
  std::optional<std::int64_t> count = {};  ///< the number of ticks, from the first one on
  /// [s] The time of the next tick as a function of the leaf's discrete state, in place of period,
  /// offset and times; infinite if there is none. The update at a tick must increase it.
  std::function<double(VectorView z)> next = {};

  /// The number of ticks; the largest number of its type if they do not end.
  std::int64_t ticks() const;
  /// The error in this declaration, in words; empty if there is none.
  std::string fault() const;
};

}  // namespace saltus
