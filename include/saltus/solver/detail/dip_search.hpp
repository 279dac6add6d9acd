// Dip search: pairs of crossings between two looks, where a guard crosses zero and comes back.
#pragma once

#include <algorithm>
#include <utility>

#include "saltus/solver/detail/crowd_locator.hpp"
#include "saltus/solver/detail/descent.hpp"
#include "saltus/solver/detail/dip.hpp"

namespace saltus {

/// Reads the last three looks at the guards, at which none has fired. Three looks can show a dip in
/// the piece between the last two, or in the one before, where nothing was seen without the third.
class DipSearch : protected CrowdLocator {
 protected:
  DipSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : CrowdLocator(machine, guards, located) {
    beside_.assign(machine.plan().look_slots, 1.0);
  }

  /// No guard fired at `to`: the offset of a dip at which a guard fires. If there is none, returns
  /// `never` and moves `from` to the end of the part that was looked at.
  template <class Interpolate>
  double next_dip(double& from, double to, const Interpolate& interpolate) {
    const double dip = scans() ? find_dip(from, to, never, interpolate) : never;
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

  /// A guard has fired at `to`: an offset at which some have fired. It is `to`, unless the look there shows
  /// that a guard dips in the piece before, where `from` is moved to its begin.
  template <class Interpolate>
  double first_crossed(double& from, double to, const Interpolate& interpolate) {
    if (!may_go_back_ || !scans()) return to;
    const double dip = find_dip(from, to, from, interpolate);
    if (!(dip < from)) return to;
    if (!note_crossed(middle_) || !fires_first_at_dip()) {
      note_crossed(high_);
      return to;
    }
    go_back(from);
    high_.swap(middle_);
    return dip;
  }

  /// The offset between two looks at which a guard crosses zero and comes back, where its parabola turns
  /// before `until`. `middle_` then has the guards at that offset; `never` if there is no such offset.
  template <class Interpolate>
  double find_dip(double from, double to, double until, const Interpolate& interpolate) {
    if (earlier_at_ == never) return never;
    const TurnRange turn = turn_range(from, to);
    for (const std::size_t k : located_->slots) {
      const Guard& guard = (*guards_)[k];
      if (guard.side == 0 || guard.at_zero() || guard.jumps) continue;
      const Dip dip{{earlier_at_, from, to},
                    {guard.side * earlier_[k], guard.side * guards_->g[k], guard.side * high_[k]}};
      if (!turn.contains(dip.g[1] - dip.g[0], dip.g[2] - dip.g[1])) continue;
      const double u = follow_slope(k, dip, until, interpolate);
      if (u != never) return u;
    }
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
    for (const std::size_t k : located_->looked) guards_->g[k] = earlier_[k];
    from = std::exchange(earlier_at_, never), oldest_at_ = never;
  }

  /// Follows the slope of guard k from the vertex of the parabola through three looks to its least
  /// value. Returns the offset where it is beyond zero; `never` if it comes to none.
  template <class Interpolate>
  double follow_slope(std::size_t k, const Dip& dip, double until, const Interpolate& interpolate) {
    const double size = std::max({dip.g[0], dip.g[1], dip.g[2]});
    const double vertex = dip.vertex(thresholds::shallow_dip * size);
    if (!(vertex < until)) return never;
    const double side = (*guards_)[k].side, near = thresholds::near_share * (dip.u[2] - dip.u[1]);
    Descent descent(may_go_back_ ? dip.u[0] : dip.u[1], dip.u[2], vertex, dip.bend());
    for (int round = 0; round < thresholds::dip_looks; ++round) {
      const double u = descent.at(), beside = u + near < dip.u[2] ? near : -near;
      look(u, nullptr, interpolate, middle_);
      const double g = side * middle_[k];
      if (g < -thresholds::dip_rounding * size) return u;  // a touch within rounding is no dip
      look(u + beside, nullptr, interpolate, beside_);
      if (!descent.take(g, (side * beside_[k] - g) / beside, 0.5 * beside)) break;
    }
    return never;
  }

  List<double> beside_;  // guards next to a look, for their slopes
};

}  // namespace saltus
