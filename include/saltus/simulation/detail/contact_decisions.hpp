// Contact decisions: whether a block at rest stays, is carried, or is released. They are functions
// of values. `pressed` is the side to which the flow presses the guard; the other side is its armed
// side (docs/semantics.md, 4.5).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// Decides about the guard of a block on hold after a commit.
///
///     value                                      then
///     within its error                           stay
///     beyond it, on the armed side               release: the surface has moved away
///     beyond it, on the pressed side, clearly    apply the reset map again: the surface carries
///     otherwise                                  stay: the surface has hardly moved
enum class Held { stay, release, apply_again };

inline Held decide_held(double g, double error, int pressed) {
  if (std::abs(g) <= error) return Held::stay;
  if (g * pressed < 0.0) return Held::release;
  return std::abs(g) > thresholds::clearly_beyond * error ? Held::apply_again : Held::stay;
}

/// Whether the guard of a relation still says that its blocks are at rest: it is within its error,
/// or the blocks are pressed into the surface.
inline bool is_pressed(double g, double error, int pressed) {
  return std::abs(g) <= error || g * pressed > 0.0;
}

/// Decides about a contact whose guard has left its error.
///
///     carried until now    may be carried    value           then
///     yes                  -                 -               release: its lift has changed sign
///     no                   yes               -               carry: its surface moves
///     no                   no                pressed side    stay, with a wider error: it wavered
///     no                   no                armed side      release
enum class Waking { carry, stay, release };

template <class MayBeCarried>
Waking decide_waking(bool carried, double g, int pressed, const MayBeCarried& may_be_carried) {
  if (carried) return Waking::release;
  if (may_be_carried()) return Waking::carry;
  return g * pressed < 0.0 ? Waking::release : Waking::stay;
}

/// Decides about a contact by its lift: how far the free flow takes its guard off the surface.
///
///     carried   pressed on until now   lift        carried   pressed on   lifts off
///     yes       -                      negative    yes       yes          no
///     no        -                      negative    no        yes          no
///     yes       -                      zero        yes       as before    no
///     no        -                      zero        no        as before    no
///     -         yes                    positive    no        yes          yes
///     -         no                     positive    no        no           no
///
/// Without a force the block stays where it is: a lift of zero changes nothing about the pressure. A
/// carried block is watched on, because the force may begin at any time.
struct Pressure {
  bool carried = false;
  bool pressed_on = false;
  bool lifts_off = false;
  bool operator==(const Pressure&) const = default;
};

constexpr Pressure decide_pressure(bool carried, bool pressed_on, double lift) {
  const bool lifts_off = pressed_on && lift > 0.0;
  return {carried && lift <= 0.0, lift == 0.0 || lifts_off ? pressed_on : lift < 0.0, lifts_off};
}

/// The value of the guard of a carried block. It fires where the lift rises above zero, not where it
/// is zero.
constexpr double guard_of_lift(double lift) {
  return lift == 0.0 ? -std::numeric_limits<double>::min() : lift;
}

/// The error of a contact whose guard left it by rounding, and was `g` then.
inline double error_after_wavering(double error, double g) {
  return std::max(error, thresholds::wavered * std::abs(g));
}

}  // namespace saltus
