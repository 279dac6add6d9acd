// Pass decisions: the guards at the begin of an instant, and after each of its passes. They are
// functions of values.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// Whether a zero crossing that is at zero within the resolution of another guard's root has crossed
/// there too. `flow_to()` is the side to which the flow takes it.
///
///     armed   flow to        crossed
///     yes     armed side     yes: it is on its firing side, and goes back
///     yes     firing side    not yet
///     yes     none           no
///     no      -              no
template <class FlowTo>
bool crossed_beside_root(Direction direction, Phase phase, const FlowTo& flow_to) {
  return phase == Phase::armed && flow_to() == -firing_side(direction);
}

/// The side on which a guard continues that came from its firing side to zero, beside the root of another one,
/// and has not left it. Only the flow may take it to its armed side: where an effect of that root turned the
/// flow round, a guard that is a rounding beyond zero has not been there.
///
///     flow to        continues on
///     armed side     its armed side
///     firing side    its firing side
///     none           its firing side
constexpr int side_beside_root(Direction direction, int flow_to) {
  const int firing = firing_side(direction);
  return flow_to == -firing ? -firing : firing;
}

/// Whether a guard, armed and not yet across, crosses at a stop: its crossing is there but for rounding.
/// `later` is its value by the flow a resolution of the time later. `flow_to()` is the side to which the flow
/// takes it; it is asked for where the guard is at zero within its uncertainty.
///
///     fires at its value, or later   within its uncertainty   flow to        crosses
///     yes                            -                        -              yes
///     no                             yes                      other side     yes, if in its direction
///     no                             yes                      its side       no: it turns back
///     no                             yes                      none           no
///     no                             no                       -              no
template <class FlowTo>
bool crosses_at_stop(const Guard& guard, double now, double later, double uncertainty,
                     const FlowTo& flow_to) {
  if (guard.phase != Phase::armed) return false;
  if (guard.crossed(now) || guard.crossed(later)) return true;
  if (guard.direction == Direction::edge_detection || !(std::abs(now) <= uncertainty)) return false;
  return fires(guard.direction, guard.side, -guard.side) && flow_to() == -guard.side;
}

/// Whether a guard that jumped from one side at a root is back on it after the relations of the same root
/// have flipped. The look at a root holds the relations before it. Beyond a jump they do not fit what they
/// read, so what follows from them is wrong: a saturated output is beyond its limit.
///
///     value after the flips   came back
///     on its side before      yes: it has never crossed
///     at zero                 no: it is there now
///     beyond zero             no
constexpr bool came_back(int from, double value) { return from * value > 0.0; }

/// A zero crossing after a pass: whether it fires in the next one, or where it is seen from now on.
///
///     holds its block   fired in this pass   queued   then
///     yes               yes                  -        nothing: its block just came to rest
///     yes               no                   -        look_at_hold: the surface may have moved
///     no                yes                  no       see: it is where its reset map left it
///     no                yes                  yes      see_behind: it is beyond zero, until its
///                                                     execution comes; then look
///     no                no                   -        look: the commit may have moved it across
enum class AfterPass { nothing, look_at_hold, see, see_behind, look };

constexpr AfterPass decide_after_pass(bool holds, bool fired, bool queued) {
  if (holds) return fired ? AfterPass::nothing : AfterPass::look_at_hold;
  if (!fired) return AfterPass::look;
  return queued ? AfterPass::see_behind : AfterPass::see;
}

/// The side of a guard after the pass in which it fired; 0: none. Within its error it is at zero, whatever the
/// rounding of its root says: a later pass that moves it off zero does not carry it across.
///
///     value              side
///     within the error   none
///     beyond it          its sign
inline int side_after_firing(double value, double error) {
  return std::abs(value) <= error ? 0 : sign_of(value);
}

/// Whether a commit that moved a guard from `before` to `now` may have meant to put it at zero.
inline bool stops_near_zero(double before, double now) {
  return std::abs(now) <= thresholds::clearly_across * std::abs(now - before);
}

/// Whether a commit moved a guard off zero. The guard was at `before`, which counts as zero, because
/// it was that close at the root of another guard; it came from its firing side. A guard that stays
/// at zero has not been on its armed side: it has not crossed, whatever the flow does afterwards.
///
///     now                                         off zero
///     as far from zero as before, or nearer       no
///     within its uncertainty                      no
///     farther                                     yes
inline bool moves_off_zero(double before, double now, double uncertainty) {
  return std::abs(now) > std::max(std::abs(before), uncertainty);
}

/// The uncertainty of a guard's value: its rounding, and its movement within the resolution of the
/// time at which a root is located.
inline double value_uncertainty(double rounding, double slope, double t) {
  const double resolution = thresholds::location_roundings * thresholds::eps * std::abs(t);
  return rounding + resolution * std::abs(slope);
}

/// Whether the flow has a say about a root of a guard that fired before: then the root may be rounding. It may be
/// where the guard was armed within its error and has not left it, or where the root follows so soon that the flow
/// has not taken the guard clearly off zero.
///
///     monitor   edge_detection   soon   armed within its error   opaque   at zero since then   asked
///     yes       -                -      -                        -        -                    no
///     no        yes              -      -                        -        -                    no
///     no        no               yes    -                        -        -                    yes
///     no        no               no     no                       -        -                    no
///     no        no               no     yes                      yes      -                    yes
///     no        no               no     yes                      no       yes                  yes
///     no        no               no     yes                      no       no: a true root      no
struct RootFacts {
  bool armed_at_zero = false;  ///< within its error
  bool monitor = false;
  bool edge = false;  ///< direction edge_detection: its zero has no meaning
  bool opaque = false;
  bool at_zero = false;  ///< it has not been clearly off zero since then
  bool soon = false;     ///< within the time in which the flow takes it clearly off zero
};

constexpr bool may_be_rounding(const RootFacts& root) {
  if (root.monitor || root.edge) return false;
  return root.soon || (root.armed_at_zero && (root.opaque || root.at_zero));
}

}  // namespace saltus
