// Dip search: pairs of crossings between two looks, where a guard crosses zero and comes back.
#pragma once

#include <algorithm>
#include <utility>

#include "saltus/solver/detail/crowd_locator.hpp"
#include "saltus/solver/detail/dip.hpp"

namespace saltus {

/// Reads the last three looks at the guards, at which none has fired. Three looks can show a dip in
/// the piece between the last two, or in the one before, where nothing was seen without the third.
class DipSearch : protected CrowdLocator {
 protected:
  using CrowdLocator::CrowdLocator;

  /// No guard fired at `to`: the offset of a dip at which a guard fires. If there is none, returns
  /// `never` and moves `from` to the end of the part that was looked at.
  template <class Interpolate>
  double next_dip(double& from, double to, const Interpolate& interpolate) {
    const double dip = scans() ? find_dip(from, to, interpolate) : never;
    const bool back = dip < from, crossed = dip != never && note_crossed(middle_);
    if (dip == never || (back && crossed && !fires_first_at_dip())) {
      shift(from), follow();
      from = never;
      return never;
    }
    if (back) go_back(from);
    high_.swap(middle_);
    if (crossed) return dip;  // otherwise it dips to its other side
    shift(from), follow();
    may_go_back_ = may_go_back_ && !back;
    from = dip;
    return never;
  }

 private:
  /// Whether the guards that fire at a dip between the last two looks were on their sides at both.
  bool fires_first_at_dip() const {
    return std::ranges::all_of(crossed_, [&](std::size_t k) {
      const double side = (*guards_)[k].plain_side();
      return side * earlier_[k] > 0.0 && side * guards_->g[k] > 0.0;
    });
  }

  /// A guard dips between the last two looks, which only the look after them showed: the first of
  /// them is the last look again.
  void go_back(double& from) {
    for (const std::size_t k : located_->slots) guards_->g[k] = earlier_[k];
    from = std::exchange(earlier_at_, never), oldest_at_ = never;
  }

  /// The offset between two looks at which a guard seems to cross zero and come back. It is the
  /// vertex of the parabola through three looks, moved by successive parabolic interpolation (R. P.
  /// Brent, "Algorithms for Minimization without Derivatives", 1973, ch. 5) until the guard there
  /// is beyond zero. `middle_` then has the guards at that offset; `never` if there is no such
  /// offset.
  template <class Interpolate>
  double find_dip(double from, double to, const Interpolate& interpolate) {
    if (earlier_at_ == never) return never;
    const double first = may_go_back_ ? earlier_at_ : from;
    for (const std::size_t k : located_->slots) {
      const Guard& guard = (*guards_)[k];
      if (guard.side == 0 || guard.at_zero() || guard.jumps || !may_dip(k, from, to)) continue;
      Dip dip{{earlier_at_, from, to},
              {guard.side * earlier_[k], guard.side * guards_->g[k], guard.side * high_[k]}};
      // A touch within rounding is no dip; nor is a vertex far above zero.
      const double size = std::max({dip.g[0], dip.g[1], dip.g[2]});
      double u = dip.vertex(thresholds::shallow_dip * size);
      for (int round = 0; round < thresholds::dip_looks && u > first && u < to; ++round) {
        look(u, nullptr, interpolate, middle_);
        const double g = guard.side * middle_[k];
        if (g < -thresholds::dip_rounding * size) return u;
        dip.replace(u, g);
        u = dip.vertex(thresholds::slow_dip * dip.g[1]);
      }
    }
    return never;
  }

  /// Whether the parabola through the three looks has a vertex between them.
  bool may_dip(std::size_t k, double from, double to) const {
    const double side = (*guards_)[k].side, r = (to - from) / (from - earlier_at_);
    const double rise = side * (high_[k] - guards_->g[k]),
                 earlier_rise = side * (guards_->g[k] - earlier_[k]);
    return rise * (1.0 + 2.0 * r) > earlier_rise * r * r && rise > earlier_rise * r * (2.0 + r);
  }
};

}  // namespace saltus
