// Glance: the work of most looks at the guards, which is to find that nothing has happened.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/look_pace.hpp"
#include "saltus/solver/detail/narrow.hpp"
#include "saltus/solver/detail/third_difference.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Remembers the guards of the last three looks, and how fast each guard moved recently.
class Glance : protected Narrower {
 protected:
  static constexpr double never = std::numeric_limits<double>::infinity();

  Glance(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : Narrower(machine, guards, located) {
    const Index slots = machine.plan().guard_slots;
    for (auto* values : {&oldest_, &earlier_, &speed_}) values->assign(slots, 1.0);
    plain_.reserve(earlier_.size());
    judged_.resize(slots);
  }

  bool scans() const { return scan_points_ > 0; }

  /// Forgets the looks before a restart, which have no meaning after it.
  void forget() { oldest_at_ = earlier_at_ = never, version_ = -1; }

  /// Whether the engine has written guard records since the last look_up_guards.
  bool outdated() const { return version_ != guards_->version(); }
  void look_up_guards() {
    version_ = guards_->version();
    set_limits();
    plain_.clear();
    jumps_ = false;
    for (const std::size_t k : located_->slots) {
      plain_.push_back((*guards_)[k].plain_side());
      jumps_ = jumps_ || (*guards_)[k].jumps;
    }
  }
  /// After a root there is no need to look up the records, because the engine writes them next.
  void forget_guards() { version_ = -1; }

  /// Whether a step needs no look inside; high_ has the guards at its end. No guard could reach
  /// zero and come back, even if it moved eight times as fast as it recently did (the bound of B.
  /// O. Shubert, "A sequential method seeking the global maximum of a function", SIAM J. Numer.
  /// Anal. 9 (1972) 379). The locator still looks into such a step from time to time.
  [[gnu::always_inline]] bool out_of_reach(double length) const {
    if (jumps_) return false;
    const double *high = high_.data(), *last = guards_->g.data(), *speed = speed_.data();
    const double* plain = plain_.data();
    for (const std::size_t k : located_->slots) {
      const double side = *plain++, now = side * high[k], sum = now + side * last[k];
      if (!(now > 0.0 && sum > thresholds::speed_margin * std::abs(high[k] - last[k]) &&
            sum > thresholds::speed_margin * (speed[k] * length)))
        return false;
    }
    return true;
  }

  /// Whether no guard can have fired between the look at `from` and high_, at `to`: each guard is
  /// clearly on its side at both, and the parabola through the last three looks has no vertex in
  /// between, nor in the piece before, where the look at `to` shows more. This is true in most
  /// steps.
  bool nothing_fired(double from, double to) const {
    const double r = (to - from) / (from - earlier_at_);
    const bool dips = earlier_at_ != never && scans();
    const double back = r * (2.0 + r);
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      const double side = plain_[i];
      const std::size_t k = located_->slots[i];
      const double now = side * high_[k], before = side * guards_->g[k];
      if (!(now > 0.0 && now < never)) return false;  // never is infinite
      if (!dips) continue;
      const double rise = now - before, earlier_rise = before - side * earlier_[k];
      // The parabola falls at `from` and rises at `to`; or falls at the earlier look and rises
      // here.
      const double turn = -earlier_rise * r * r;
      if (rise < turn ? rise * (1.0 + 2.0 * r) > -turn : may_go_back_ && rise > earlier_rise * back)
        return false;
    }
    return true;
  }
  /// The look at `from` becomes the look before the next one, and no guard fired. A step keeps a
  /// part of the speeds of those before; its pieces keep all of those of the step.
  [[gnu::always_inline]] void shift_all(double from, double to,
                                        double memory = thresholds::speed_memory) {
    const double* high = high_.data();
    double *last = guards_->g.data(), *speed = speed_.data(), *earlier = earlier_.data(),
           *oldest = oldest_.data();
    for (const std::size_t k : located_->slots) {
      speed[k] = std::max(memory * speed[k], std::abs(high[k] - last[k]) / (to - from));
      oldest[k] = earlier[k], earlier[k] = last[k], last[k] = high[k];
    }
    oldest_at_ = earlier_at_, earlier_at_ = from, may_go_back_ = true;
  }

  /// A step that is looked into begins.
  void slow_down() {
    for (const std::size_t k : located_->slots) speed_[k] *= thresholds::speed_memory;
  }

  /// The look at `from` becomes the look before the next one. No guard fired since.
  void shift(double from) {
    set_earlier(from, guards_->g);
    may_go_back_ = true;
  }

  /// The guards at a look become those at the look before the last.
  void set_earlier(double at, const std::vector<double>& guards) {
    oldest_.swap(earlier_), earlier_ = guards;
    oldest_at_ = earlier_at_, earlier_at_ = at;
  }

  /// The last three looks.
  struct Looks {
    List<double> last, earlier, oldest;
    double earlier_at, oldest_at;
  };
  void keep_looks(Looks& in) const {
    in.last = guards_->g, in.earlier = earlier_, in.oldest = oldest_;
    in.earlier_at = earlier_at_, in.oldest_at = oldest_at_;
  }
  void set_looks(const Looks& to) {
    guards_->g = to.last, earlier_ = to.earlier, oldest_ = to.oldest;
    earlier_at_ = to.earlier_at, oldest_at_ = to.oldest_at, may_go_back_ = false;
  }

  /// Whether there are three looks, and the one at high_.
  bool has_four_looks() const { return earlier_at_ != never && oldest_at_ != never; }

  /// Whether what the last four looks say of the piece between the last two is such, for some guard
  /// that can fire there.
  template <class Is>
  bool any_varies(double from, double to, const Is& is) const {
    if (!has_four_looks()) return false;
    const ThirdDifference bound(oldest_at_, earlier_at_, from, to);
    return std::ranges::any_of(
        located_->slots, [&](std::size_t k) { return counts(k) && is(k, variation(k, bound)); });
  }

  bool hides(double from, double to) const {
    return any_varies(from, to, [](std::size_t, const Variation& each) { return each.hides(); });
  }
  bool is_slow(double from, double to) const {
    return !any_varies(from, to,
                       [](std::size_t, const Variation& each) { return !each.is_slow(); });
  }

  /// The shortest piece hides something: notes which guards do.
  void note_in_vain(double from, double to) {
    const ThirdDifference bound(oldest_at_, earlier_at_, from, to);
    for (const std::size_t k : located_->slots)
      if (counts(k) && variation(k, bound).hides()) judged_[k].fail();
  }
  void begin_judging() {
    for (const std::size_t k : located_->slots) judged_[k].begin_step();
  }

  /// The guards take their sides at high_, where no guard fired.
  void follow() {
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const std::size_t k = located_->slots[i];
      const Guard& guard = (*guards_)[k];
      const bool stays =
          !guard.waits() && (guard.side > 0 ? high_[k] > 0.0 : guard.side < 0 && high_[k] < 0.0);
      guards_->g[k] = high_[k];
      if (stays) continue;
      guards_->follow(k, high_[k]);
      limits_[i] = guard.limits();
      plain_[i] = guard.plain_side();
    }
  }

  List<double> earlier_, oldest_;  // guards at the look before the last, and at the one before
  double earlier_at_ = never;      // its offset; below zero: in the step before
  double oldest_at_ = never;       // the offset of the one before
  bool may_go_back_ =
      false;             // the piece that begins there is of this step, and nothing fired in it
  int scan_points_ = 0;  // interior points of a step with a look

 private:
  bool counts(std::size_t k) const {
    const Guard& guard = (*guards_)[k];
    return judged_[k].yes() && !guard.jumps && guard.phase != Phase::resting;
  }
  Variation variation(std::size_t k, const ThirdDifference& bound) const {
    const double g0 = oldest_[k], g1 = earlier_[k], g2 = guards_->g[k], g3 = high_[k];
    const auto [low, high] = std::minmax({g0, g1, g2, g3});
    const bool crosses = (g2 > 0.0) != (g3 > 0.0);
    return {std::abs(bound.of(g0, g1, g2, g3)), high - low,
            crosses ? 0.0 : std::min(std::abs(g2), std::abs(g3))};
  }

  List<double> plain_;         // plain_side() of each active guard
  List<double> speed_;         // [1/s] recent speed of each guard
  List<Judged> judged_;        // whether each guard counts for the distance of the looks
  std::int64_t version_ = -1;  // of the records from which limits_ and plain_ were made
  bool jumps_ = false;         // some active guard takes two values only
};

}  // namespace saltus
