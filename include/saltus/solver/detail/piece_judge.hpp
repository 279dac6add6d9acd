// PieceJudge: whether the last four looks at the guards show what happens in a piece of a step.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/guard_set.hpp"
#include "saltus/solver/detail/look_pace.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/third_difference.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// The values of the guards at four looks in a row. The piece that is judged is between the last
/// two.
struct FourLooks {
  const double *oldest, *earlier, *last, *high;
  ThirdDifference bound;  ///< of the offsets of these looks
  bool near = false;      ///< whether the last two are so near that they show a guard of two values
  double time_rounding = 0.0;  ///< [of the piece] how far their offsets may be off

  LookVariation variation(std::size_t k) const {
    const double g0 = oldest[k], g1 = earlier[k], g2 = last[k], g3 = high[k];
    const double least = std::min(std::min(g0, g1), std::min(g2, g3));
    const double greatest = std::max(std::max(g0, g1), std::max(g2, g3));
    const bool crosses = (g2 > 0.0) != (g3 > 0.0);
    return {std::abs(bound.of(g0, g1, g2, g3)), greatest - least,
            crosses ? 0.0 : std::min(std::abs(g2), std::abs(g3)),
            near && (g0 == g1) + (g1 == g2) + (g2 == g3) == 2, crosses};
  }
  /// The same of a value that guards read. No place of it is known where they change, so it may do so
  /// anywhere, and it has to be shown better than a guard. What the roundings of the value and of the
  /// times explain is no error: a guard does not come near to zero by them, but such a value would hide
  /// something in all pieces that are short enough.
  LookVariation variation_of_read(std::size_t k) const {
    LookVariation of = variation(k);
    const double size = std::max(std::max(std::abs(oldest[k]), std::abs(earlier[k])),
                                 std::max(std::abs(last[k]), std::abs(high[k])));
    const double each =
        thresholds::read_roundings * thresholds::eps * size + time_rounding * of.range;
    of.error = thresholds::read_room * std::max(0.0, of.error - bound.rounding(each));
    of.least = 0.0;
    return of;
  }
};

/// Judges a piece by the guards that are located together. A guard that jumps, or whose block is at
/// rest, does not count: no distance of the looks shows more of it. What guards read counts beside
/// them, because a function that is not known to be smooth shows less than what it reads.
class PieceJudge {
 public:
  PieceJudge(const GuardSet& guards, const LocatedGuards& located, Index slots)
      : guards_(&guards), located_(&located) {
    judged_.resize(slots);
  }

  /// A step that is looked into begins.
  void begin_step(std::size_t k) { judged_[k].begin_step(); }

  /// Whether some guard that counts is such, by a test of its number and its LookVariation. The test
  /// comes first, because it excludes most guards.
  template <class Is>
  [[gnu::always_inline]] bool any(const FourLooks& looks, const Is& is) const {
    for (const std::size_t k : located_->slots)
      if (is(k, looks.variation(k)) && counts(k)) return true;
    for (const LookedRead& read : located_->reads)
      if (is(read.slot, looks.variation_of_read(read.slot)) && counts(read)) return true;
    return false;
  }
  /// Whether some guard may have crossed zero where the looks do not show it.
  [[gnu::always_inline]] bool hides(const FourLooks& looks) const {
    return any(looks, [](std::size_t, const LookVariation& each) { return each.hides(); });
  }
  /// Whether looks at twice the distance would show all guards, too.
  bool is_slow(const FourLooks& looks) const {
    return !any(looks, [](std::size_t, const LookVariation& each) { return !each.is_slow(); });
  }
  /// Whether some guard crosses zero between the last two looks.
  bool crosses(const FourLooks& looks) const {
    return any(looks, [](std::size_t, const LookVariation& each) { return each.crosses; });
  }
  /// The shortest piece hides something: notes which guards do.
  void note_in_vain(const FourLooks& looks) {
    for (const std::size_t k : located_->slots)
      if (looks.variation(k).hides() && counts(k)) judged_[k].fail();
    for (const LookedRead& read : located_->reads)
      if (looks.variation_of_read(read.slot).hides() && counts(read)) judged_[read.slot].fail();
  }
  /// A piece of near looks is not halved: notes which guards seem to be noise.
  void note_noise(const FourLooks& looks) {
    for (const std::size_t k : located_->slots) judged_[k].note(looks.variation(k).is_noise());
    for (const LookedRead& read : located_->reads)
      judged_[read.slot].note(looks.variation_of_read(read.slot).is_noise());
  }

 private:
  bool counts(std::size_t k) const {
    const Guard& guard = (*guards_)[k];
    return judged_[k].yes() && !guard.jumps && guard.phase != Phase::resting;
  }
  /// What guards read counts while one of their blocks is not at rest.
  bool counts(const LookedRead& read) const {
    if (!judged_[read.slot].yes()) return false;
    for (std::size_t k = read.first_guard; k <= read.last_guard; ++k)
      if ((*guards_)[k].phase != Phase::resting) return true;
    return false;
  }

  const GuardSet* guards_;
  const LocatedGuards* located_;
  List<Judged> judged_;
};

}  // namespace saltus
