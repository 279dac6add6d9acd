// Crossing decisions: the side on which a zero crossing continues, whether it fires at once, whether
// it rests. They are functions of values. They ask for a fact about the flow only when they need it,
// because the fact costs calls of the right-hand side.
//
// The law: a guard is at zero within its error; its side is known only beyond it; within it the
// flow decides (docs/semantics.md, 2.2 to 2.5).
#pragma once

#include <cmath>
#include <optional>

#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// The author's wish for a guard that begins at zero or beyond it (2.4).
///
///     at_start       g off zero, armed side   g = 0              g on the firing side
///     automatic      by the flow              by the flow        by the flow
///     error          by the flow              refuse             refuse
///     fire           by the flow              fire               fire
///     ignore         by the flow              wait               by the flow: it waits anyway
///
/// A guard of either direction has no firing side until it is armed; edge_detection has none.
enum class Beginning { by_flow, refuse, fire, wait };

constexpr Beginning decide_beginning(AtStart wish, Direction direction, double g) {
  if (wish == AtStart::automatic || direction == Direction::edge_detection)
    return Beginning::by_flow;
  const bool beyond = firing_side(direction) * g > 0.0 && direction != Direction::crosses_zero;
  if (g != 0.0 && !beyond) return Beginning::by_flow;
  if (wish == AtStart::error) return Beginning::refuse;
  if (wish == AtStart::fire) return Beginning::fire;
  return g == 0.0 ? Beginning::wait : Beginning::by_flow;
}

/// The side to which the flow takes a guard (0: it stays within its error), and that error.
struct FlowSide {
  int side = 0;
  double error = 0.0;
};

/// The facts about a zero crossing just before integration continues.
struct CrossingFacts {
  Direction direction = Direction::crosses_zero;
  Phase phase = Phase::armed;
  int side = 0;              ///< its side until now
  double g = 0.0;            ///< its value
  double error = 0.0;        ///< until now
  bool at_start = false;     ///< the run begins here
  bool entered = false;      ///< its mode was entered in this instant
  bool put_at_zero = false;  ///< the last commit moved it to zero, within its error
  bool fired = false;        ///< in this instant
  int came_from = 0;         ///< the side it fired from
  bool effect = false;       ///< it writes a state or a mode
  bool reset = false;        ///< by a reset map
  int resets = 0;            ///< in this instant, of blocks whose continuous state changes it
  bool jumped = false;       ///< at its root: its value does not say how far its zero is

  bool either() const { return direction == Direction::crosses_zero; }
  bool wrote() const { return resets > 0; }
  /// The side that it fires from. A guard of either direction is armed where it is.
  int armed_side() const { return either() ? side : -firing_side(direction); }
  /// Whether it is on its firing side already; a guard of either direction never is.
  bool is_beyond() const { return !either() && side == firing_side(direction); }
  /// Whether a flow to this side crosses zero in its direction.
  bool crosses_to(int to) const { return to != 0 && to == -armed_side(); }
  /// Whether a reset turned the flow round, to this side.
  bool is_turned_to(int to) const { return wrote() && crosses_to(to) && !is_beyond(); }
  /// Whether a reset may have struck what is in contact, a rounding beyond zero: see decide_at_zero.
  bool may_be_struck() const { return !fired && effect && wrote() && is_beyond(); }
};

/// Whether a zero crossing has to be armed by the flow. `uncertainty()` is the error of its value
/// by the rounding of the states and of the time.
///
///     edge_detection                                           no: its zero has no meaning
///     fired in this instant                                    yes
///     moved to zero by the last commit                         yes
///     at zero, or within its error while it waits              yes, unless it waits and nothing
///                                                              was written: dormant as before
///     mode just entered, within `uncertainty()`                yes
///     with an effect, on its firing side, within               yes
///     `uncertainty()`, and a reset of this instant wrote
///     otherwise                                                no: it keeps the side it has
template <class Uncertainty>
bool needs_flow(const CrossingFacts& guard, const Uncertainty& uncertainty) {
  if (guard.direction == Direction::edge_detection) return false;
  if (guard.fired || guard.put_at_zero) return true;
  if (guard.may_be_struck() && std::abs(guard.g) <= uncertainty()) return true;
  const bool waits = guard.phase == Phase::waiting;
  const bool at_zero = guard.g == 0.0 || (waits && std::abs(guard.g) <= guard.error) ||
                       (guard.entered && std::abs(guard.g) <= uncertainty());
  return at_zero && !(waits && !guard.wrote());
}

/// The decision about a guard. Without a phase the guard keeps its phase and its side, and gets the
/// new error.
struct Arming {
  enum class Then { go_on, fire, rest };
  /// The error within which a guard waits: its rounding; or the tolerance of the run, if it leaves
  /// zero along the surface.
  enum class Within { rounding, tolerance };
  std::optional<Phase> phase = {};
  int side = 0;
  Then then = Then::go_on;
  int from = 0;  ///< the side that a firing at once comes from
  Within within = Within::rounding;
  bool operator==(const Arming&) const = default;
};

/// Whether a motion begins in contact with the surface of a guard: see decide_at_zero.
template <class Ask>
bool begins_in_contact(const CrossingFacts& guard, int flow_to, const Ask& ask) {
  const bool may_begin = guard.at_start || (guard.entered && guard.effect);
  return may_begin && flow_to == firing_side(guard.direction) &&
         (!guard.either() || ask.slope() == 0.0) && (guard.at_start || ask.stood_still());
}

/// Whether a guard leaves zero along the surface: see decide_at_zero.
template <class Ask>
bool leaves_along_surface(const CrossingFacts& guard, bool to_armed_side, const Ask& ask) {
  return guard.entered && guard.effect && to_armed_side && ask.slope() == 0.0;
}

/// Whether a reset turned the flow round into the surface of a guard: see decide_at_zero.
template <class Ask>
bool meets_turned_flow(const CrossingFacts& guard, int flow_to, const Ask& ask) {
  if (guard.may_be_struck()) return flow_to == guard.side && ask.is_struck();
  if (!guard.is_turned_to(flow_to)) return false;
  const bool passed = guard.either() && guard.phase == Phase::waiting;
  return !passed || (guard.reset && ask.reset_turns(guard.side));
}

/// Decides about a guard at zero that has not fired. A guard with an effect is in contact if the
/// flow takes it to its firing side. It fires at once if the run begins so, if its mode was just
/// entered and nothing that moves it moved before, or if a reset just turned the flow round. All
/// other guards wait until they have been clearly off zero (2.3). If the
/// flow keeps a guard with an effect at zero, the guard is dormant (2.6): it keeps its armed side.
///
/// A guard that the last commit moved to zero has arrived there: it fires unless the flow takes it
/// back to its armed side (3.4).
///
///     effect  flow to        begins or turned   then     waits on
///     yes     firing side    yes                fire     the flow's side
///     yes     firing side    no                 go on    the flow's side
///     no      firing side    -                  go on    the flow's side
///     yes     none           -                  go on    its armed side; no side if it was on its
///                                                        firing side already
///     no      none           -                  go on    no side
///     -       armed side     -                  go on    the flow's side
///
/// A guard with an effect whose mode was just entered, and whose slope is zero, leaves zero along
/// the surface: it counts as zero within the tolerance of the run, as after a lift-off.
///
/// A guard of either direction is in contact at the start only if its slope is zero and the
/// flow leads down. A reset turns the flow round for a guard that is not on its firing side
/// already. A reset strikes a guard that is on its firing side, within its uncertainty, if the
/// guard hardly moved before: bodies that touch, and overlap by a rounding, meet. A guard of
/// either direction that waits at zero has no firing side: it was passed through, and is in
/// contact only if its own reset map sends the flow back.
template <class Ask>
Arming decide_at_zero(const CrossingFacts& guard, FlowSide flow, const Ask& ask) {
  const int armed = guard.armed_side();
  const bool begins = begins_in_contact(guard, flow.side, ask);
  const bool dormant = flow.side == 0 && guard.effect && !guard.is_beyond();
  Arming arming{.phase = Phase::waiting, .side = dormant ? armed : flow.side};
  if (leaves_along_surface(guard, flow.side == 0 ? dormant : flow.side == armed, ask))
    arming.within = Arming::Within::tolerance;
  if (guard.put_at_zero && flow.side != armed)
    arming.then = Arming::Then::fire, arming.from = armed;
  else if (guard.effect && (begins || meets_turned_flow(guard, flow.side, ask)))
    arming.then = Arming::Then::fire, arming.from = -flow.side;
  return arming;
}

/// The part of decide_fired for a guard with a reset map that is at zero or beyond it: whether it
/// fires again or rests. `arming` says how it waits if it does neither.
template <class Ask>
Arming decide_return(const CrossingFacts& guard, FlowSide flow, const Ask& ask, Arming arming) {
  const int from = guard.came_from;
  const bool low = ask.too_low(), back = low || flow.side == -from;
  if (!back) return arming;
  if (std::abs(guard.g) > flow.error && !(guard.jumped && ask.stops_at_jump())) return arming;
  if (guard.resets > 1 && ask.reset_turns(from))
    arming.then = Arming::Then::fire, arming.from = from;
  else if (low || ask.leads_back())
    arming.then = ask.moves_together() ? Arming::Then::go_on : Arming::Then::rest,
    arming.side = from;
  return arming;
}

/// Decides about a guard that has fired in this instant (2.5).
///
/// "Back" is the flow to the firing side, or to any side after a flight too low to be seen.
///
///     reset map   flow leads       value              then
///     yes         -                beyond its error,  go on, armed
///                                  armed side
///     yes         back             within its error   fire, if another reset of this instant
///                                                     wrote, and its own sends the flow off
///     yes         back             within its error   go on, if the flight was too low, or the guard
///                                                     was not merely passed through, and what would
///                                                     rest moves together; waits on its armed side
///     yes         back             within its error   rest, likewise, if it does not
///     yes         back             within its error   otherwise go on; waits on the flow's side
///     yes         back             beyond it, firing  as within its error, if it jumped, the states
///                                  side               are at its jump, and leave it as from rest
///     yes         back             beyond it, firing  otherwise go on; waits on the flow's side
///                                  side
///     yes         off              -                  go on; waits on the flow's side
///     no          -                -                  go on; waits on the flow's side
///
/// If the flow keeps it at zero, it waits on the side it came from, if it has a reset map and some
/// reset map of this instant wrote; otherwise it waits on no side.
template <class Ask>
Arming decide_fired(const CrossingFacts& guard, FlowSide flow, const Ask& ask) {
  const int from = guard.came_from;
  if (guard.reset && from * guard.g > flow.error) return {.phase = Phase::armed, .side = from};
  const int kept = guard.reset && guard.wrote() ? from : 0;
  const Arming waits{.phase = Phase::waiting, .side = flow.side != 0 ? flow.side : kept};
  return guard.reset ? decide_return(guard, flow, ask, waits) : waits;
}

/// Decides about a zero crossing that needs the flow.
///
///     mode just entered, with an effect, headed for its firing    fire: both modes lead to the
///     side, and the flow of the mode before led the other way     surface (4.7)
///     otherwise, fired, also since its mode was entered           decide_fired
///     otherwise                                                   decide_at_zero
///
/// A hop lower than the tolerance begins on one side, and the look ahead sees it end on the other.
/// Therefore in a mode just entered the slope decides against the side, if it is sure.
template <class Ask>
Arming decide_crossing(const CrossingFacts& guard, FlowSide flow, const Ask& ask) {
  const bool entered = guard.entered && !guard.fired;
  if (entered && flow.side * ask.slope() < 0.0 && ask.is_slope_sure()) flow.side = -flow.side;
  const bool its_side = guard.either() ? flow.side != 0 : flow.side == firing_side(guard.direction);
  if (entered && guard.effect && its_side && ask.turned_round(flow.side))
    return {.then = Arming::Then::fire, .from = -flow.side};
  return guard.fired ? decide_fired(guard, flow, ask) : decide_at_zero(guard, flow, ask);
}

/// Whether a root of a guard that has not been clearly off zero since it was armed on the side `from` is false.
/// `value` is its value there; the flow was followed over its flight at most.
///
///     flow to        value              false root
///     side `from`    -                  yes: it still leaves zero
///     other side     -                  no: it has come back
///     none           within its error   yes: nothing shows that it has left zero
///     none           beyond it          no
inline bool is_false_root(int from, double value, FlowSide flow) {
  if (flow.side != 0) return flow.side == from;
  return std::abs(value) <= flow.error;
}

/// Whether a guard was merely passed through: the flow before the reset had the same direction, and
/// the reset did not nearly stop it. Both arguments are slopes towards the firing side.
constexpr bool passed_through(double onward, double before) {
  return before > 0.0 && onward > thresholds::stopped_slope * before;
}

/// Whether a reset struck bodies in contact, which hardly moved towards each other or apart before.
/// Both arguments are slopes towards the firing side.
inline bool is_struck(double onward, double before) {
  return onward > 0.0 && std::abs(before) < thresholds::struck_slope * onward;
}

}  // namespace saltus
