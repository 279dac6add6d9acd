// Glance: the work of most looks at the guards, which is to find that nothing has happened.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/clear_piece.hpp"
#include "saltus/solver/detail/narrow.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/turn_range.hpp"

namespace saltus {

/// Remembers the guards of the last three looks, and how fast each guard moved recently.
class Glance : protected Narrower {
 protected:
  static constexpr double never = std::numeric_limits<double>::infinity();

  Glance(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : Narrower(machine, guards, located) {
    const Index slots = machine.plan().look_slots;
    for (auto* values : {&oldest_, &earlier_, &speed_}) values->assign(slots, 1.0);
    plain_.reserve(earlier_.size()), least_move_.reserve(earlier_.size());
  }

  bool scans() const { return scan_points_ > 0; }

  /// Forgets the looks before a restart, which have no meaning after it.
  void forget() { oldest_at_ = earlier_at_ = never, version_ = -1; }

  /// Whether the engine has written guard records since the last look_up_guards.
  bool outdated() const { return version_ != guards_->version(); }
  void look_up_guards() {
    version_ = guards_->version();
    set_limits();
    const std::size_t count = located_->slots.size();
    plain_.resize(count), least_move_.resize(count), jumps_ = false;
    double *plain = plain_.data(), *least = least_move_.data();
    for (const std::size_t k : located_->slots) {
      const Guard& guard = (*guards_)[k];
      *plain++ = guard.plain_side(), jumps_ = jumps_ || guard.jumps;
      *least++ = guard.stepped ? std::numeric_limits<double>::denorm_min() : 0.0;
    }
  }
  /// After a root there is no need to look up the records, because the engine writes them next.
  void forget_guards() { version_ = -1; }

  /// Whether a step needs no look inside; high_ has the guards at its end. No guard could reach
  /// zero and come back, even if it moved eight times as fast as it recently did (the bound of B.
  /// O. Shubert, "A sequential method seeking the global maximum of a function", SIAM J. Numer.
  /// Anal. 9 (1972) 379). The locator still looks into such a step from time to time. How fast a
  /// guard moved says nothing of a function whose reads are looked at, because it may have steps;
  /// nor of one that may have steps and had one value at both ends.
  [[gnu::always_inline]] bool out_of_reach(double length) const {
    if (jumps_ || !located_->reads.empty()) return false;
    const double *high = high_.data(), *last = guards_->g.data(), *speed = speed_.data();
    const double *plain = plain_.data(), *least = least_move_.data();
    for (const std::size_t k : located_->slots) {
      const double side = *plain++, now = side * high[k], sum = now + side * last[k];
      const double move = std::abs(high[k] - last[k]);
      if (!(now > 0.0 && move >= *least++ && sum > thresholds::speed_margin * move &&
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
    const TurnRange turn = turn_range(from, to);
    const bool dips = earlier_at_ != never && scans();
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      const double side = plain_[i];
      const std::size_t k = located_->slots[i];
      const double now = side * high_[k], before = side * guards_->g[k];
      if (!(now > 0.0 && now < never)) return false;  // never is infinite
      if (dips && turn.contains(before - side * earlier_[k], now - before)) return false;
    }
    return true;
  }
  /// The same by a test that most pieces pass.
  [[gnu::always_inline]] bool nothing_fired(const ClearPiece& piece) const {
    const double *high = high_.data(), *last = guards_->g.data(), *earlier = earlier_.data(),
                 *oldest = oldest_.data(), *plain = plain_.data();
    for (const std::size_t k : located_->slots)
      if (!piece.passes(*plain++, oldest[k], earlier[k], last[k], high[k])) return false;
    return true;
  }
  /// Where the last three looks, the last of them at `to`, can show a dip.
  TurnRange turn_range(double from, double to) const {
    return {(to - from) / (from - earlier_at_), may_go_back_, to == end_at_};
  }
  /// The look at `from` becomes the look before the next one, and no guard fired. A step keeps a
  /// part of the speeds of those before; its pieces keep all of those of the step.
  [[gnu::always_inline]] void shift_all(double from, double to,
                                        double memory = thresholds::speed_memory) {
    const double* high = high_.data();
    double *last = guards_->g.data(), *speed = speed_.data(), *earlier = earlier_.data(),
           *oldest = oldest_.data();
    for (const std::size_t k : located_->looked) {
      speed[k] = std::max(memory * speed[k], std::abs(high[k] - last[k]) / (to - from));
      oldest[k] = earlier[k], earlier[k] = last[k], last[k] = high[k];
    }
    oldest_at_ = earlier_at_, earlier_at_ = from, may_go_back_ = true;
  }

  /// A step that is looked into begins.
  void slow_down(std::size_t k) { speed_[k] *= thresholds::speed_memory; }

  /// The look at `from` becomes the look before the next one. No guard fired since.
  void shift(double from) {
    set_earlier(from, guards_->g);
    may_go_back_ = true;
  }

  /// The guards at a look become those at the look before the last.
  void set_earlier(double at, const List<double>& guards) {
    oldest_.swap(earlier_), copy_values(guards, earlier_);
    oldest_at_ = earlier_at_, earlier_at_ = at;
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
    follow_reads();
  }
  /// What guards read at high_ is what they read at the last look.
  void follow_reads() {
    for (const LookedRead& read : located_->reads) guards_->g[read.slot] = high_[read.slot];
  }

  List<double> earlier_, oldest_;  // guards at the look before the last, and at the one before
  double earlier_at_ = never;      // its offset; below zero: in the step before
  double oldest_at_ = never;       // the offset of the one before
  // The piece that begins at the look before the last is of this step, and nothing fired in it.
  bool may_go_back_ = false;
  List<double> speed_;   // [1/s] recent speed of each guard
  int scan_points_ = 0;  // interior points of a step with a look
  double end_at_ = 0.0;  // where the part of a step that is searched ends

 private:
  List<double> plain_;         // plain_side() of each active guard
  List<double> least_move_;    // above 0 for one that may be constant while the state varies
  std::int64_t version_ = -1;  // of the records from which limits_ and plain_ were made
  bool jumps_ = false;         // some active guard takes two values only
};

}  // namespace saltus
