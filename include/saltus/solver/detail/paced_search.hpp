// Paced search: an evenly spaced piece of a step in shorter pieces, where a guard varies too fast.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/look_pace.hpp"
#include "saltus/solver/detail/piece_judge.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"
#include "saltus/solver/detail/timed_search.hpp"

namespace saltus {

/// Controls the distance of the looks as a method controls its steps: a piece that may hide
/// something is halved, and the pieces grow again where the guards are slow.
class PacedSearch : protected TimedSearch {
 protected:
  PacedSearch(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : TimedSearch(machine, guards, located), judge_(guards, located, machine.plan().look_slots) {
    for (auto* values : {&at_end_, &begin_.last, &begin_.earlier, &begin_.oldest})
      values->assign(machine.plan().look_slots, 1.0);
  }

  void begin_run() { pace_.begin_run(), probe_ = {}; }

  bool shows(double length) const { return pace_.shows(length); }

  /// The looks of a step must show the guards whose periods are known.
  template <class Interpolate>
  void limit_pieces(double from, double to, const Interpolate& interpolate) {
    pace_.limit(longest_piece(from, to, interpolate));
  }

  /// Keeps what outlives a restart: the pace, which guards count, and how fast they move.
  void keep() {
    kept_pace_ = pace_, kept_judge_ = judge_, kept_speed_ = speed_, kept_probe_ = probe_;
  }
  void restore() {
    pace_ = kept_pace_, judge_ = kept_judge_, speed_ = kept_speed_, probe_ = kept_probe_;
  }

  /// The pieces of a step begin at `from`; `even` [s] is the distance of evenly spaced looks.
  template <class Interpolate>
  void begin_pieces(double from, double even, const Interpolate& interpolate) {
    resolution_ = thresholds::eps * (std::abs(t0_) + end_at_);
    refines_ = scans() && even * thresholds::step_piece > thresholds::look_roundings * resolution_;
    even_looks_ = 1;
    if (scans()) {
      for (const std::size_t k : located_->looked)
        slow_down(k), judge_.begin_step(k), keep_looks(k);
    }
    if (!refines_) return;
    even_ = even, records_may_differ_ = false;
    least_ = std::max(even * thresholds::finest_piece, thresholds::look_roundings * resolution_);
    pace_.see(end_at_ - from);
    bool unknown = pace_.begin_step(even, least_);
    if (located_->follow_time != FollowsTime::no) unknown = doubts(from, unknown, interpolate);
    const bool judges_all = pace_.is_finer_than(even) && has_four_looks();
    back_to_ = judges_all ? never : from;
    begin_.earlier_at = earlier_at_, begin_.oldest_at = oldest_at_;
    if (unknown) choose_pace(from, interpolate);
  }

  /// [s] The length of the first piece, of which an even one is `even` long.
  double next_piece(double even) const { return refines_ ? pace_.next(even) : even; }

  /// `find_in_piece` between two evenly spaced looks, in shorter pieces where a guard varies too
  /// fast for one; `high_` has the guards at its end.
  template <class Interpolate>
  [[gnu::always_inline]] bool find_in_even(double from, double to, const double* end,
                                           const Interpolate& interpolate) {
    if (is_clear(from, to) && !reads_hide(from, to)) {
      ++even_looks_;
      shift_all(from, to, 1.0);
      return false;
    }
    even_looks_ = 1;
    if (refines_ && (pace_.is_finer_than(to - from) || hides(from, to)))
      return find_in_shorter(from, to, end, interpolate);
    return find_in_piece(from, to, end, interpolate);
  }

 private:
  /// Whether the distance of the looks has to be chosen anew: because of a guard that follows the time,
  /// or `anyway`. Then `choose_pace` asks the functions that are due, at one of its own looks.
  template <class Interpolate>
  bool doubts(double from, bool anyway, const Interpolate& interpolate) {
    begin_asking();
    if (asks() && !anyway) {
      look(from, nullptr, interpolate, before_);
      ask(from, before_, even_, interpolate);
    }
    return anyway || (follow_time() && pace_.is_doubtful(even_, earlier_at_ == never));
  }

  /// The last three looks.
  struct Looks {
    List<double> last, earlier, oldest;
    double earlier_at, oldest_at;
  };

  template <class Interpolate>
  [[gnu::noinline]] bool find_in_shorter(double from, double to, const double* end,
                                         const Interpolate& interpolate) {
    copy_values(high_, at_end_);
    if (!pace_.is_finer_than(to - from) && pace_.halve(to - from, least_)) from = back_from(from);
    while (from < to) {
      const double next = next_look(from, to);
      if (next == to)
        copy_values(at_end_, high_);
      else
        look(next, nullptr, interpolate, high_);
      const bool hidden = hides(from, next);
      if (hidden && pace_.halve(next - from, least_)) {
        from = back_from(from);
        continue;
      }
      accept(from, next, hidden);
      if (find_in_piece(from, next, next == to ? end : nullptr, interpolate)) return true;
      from = next;
    }
    return false;
  }

  /// Where the next look is, in a piece that may be divided.
  double next_look(double from, double to) const {
    const double piece = pace_.next(to - from);
    if (piece >= to - from) return to;
    return from + (follow_time() ? pace_.part() : 1.0) * piece;
  }

  /// A piece that is not halved: the looks grow apart after it where they may.
  void accept(double from, double to, bool hidden) {
    if (!has_four_looks()) return;
    const FourLooks looks = four_looks(from, to);
    back_to_ = never;
    if (looks.near) judge_.note_noise(looks);
    if (hidden)
      judge_.note_in_vain(looks);
    else if (follow_time())
      pace_.accept(to - from, judge_.is_slow(looks), t0_ + to, judge_.crosses(looks));
    else
      pace_.accept(to - from, judge_.is_slow(looks));
  }

  /// A piece that begins at `from` hides something. The pieces before it in this step were as long,
  /// so they may hide something too, even where no look showed it: looks that are too far apart may
  /// miss by chance how a guard varies. So the search goes back to where the first of these pieces
  /// begins, with the looks of that point: this offset is returned, otherwise `from`. It does not
  /// go back where shorter pieces were judged since, nor where the record of a guard has changed,
  /// because a crossing may have been noted.
  double back_from(double from) {
    if (records_may_differ_ || back_to_ == never || from == back_to_) return from;
    set_looks();
    return back_to_;
  }

  /// In the first step of a run, and in a much longer step than all before, no look says how fast the
  /// guards vary; see LookPace::is_doubtful for guards that follow the time. Looks at three points, not
  /// evenly spaced, and compares them with the derivatives of the guards along the flow where the step
  /// begins, because a guard may have the period of the looks.
  template <class Interpolate>
  void choose_pace(double from, const Interpolate& interpolate) {
    const double most = std::min(even_, (end_at_ - from) / 3.0);
    for (double piece = follow_time() ? pace_.next(most) : most;; piece *= 0.5) {
      look(from + thresholds::near_share * piece, nullptr, interpolate, before_);
      copy_values(begin_.last, oldest_), oldest_at_ = from;
      earlier_at_ = from + piece;
      look(earlier_at_, nullptr, interpolate, earlier_);
      if (asks()) ask(earlier_at_, earlier_, even_, interpolate);
      const double third = from + thresholds::golden_ratio * piece, last = from + 3.0 * piece;
      look(third, nullptr, interpolate, middle_);
      look(last, nullptr, interpolate, high_);
      const bool hidden = hides_from_begin(third, last) ||
                          (follow_time() && hides_in_time(from, third, interpolate));
      set_looks();
      if (!hidden || !pace_.halve(piece, least_)) return;
    }
  }

  /// Whether some guard varies faster than the looks at oldest_at_, earlier_at_, `third` and `last` and
  /// the derivatives at the first of these can show. A guard that follows the time is judged also where it
  /// is far from zero.
  bool hides_from_begin(double third, double last) {
    constexpr double pieces = 1.0 / thresholds::near_share;  // from the difference to a piece
    for (const std::size_t k : located_->looked) guards_->g[k] = middle_[k];  // no others
    const bool timed = follow_time();
    return judge_.any(four_looks(third, last), [&](std::size_t k, const LookVariation& each) {
      const double move = std::abs(before_[k] - begin_.last[k]) * pieces;  // in a piece
      return (timed ? each.is_noise() : each.hides()) ||
             move > thresholds::steep_ranges * each.range;
    });
  }

  /// The same by one more look, in the first piece. Four looks that are much too far apart seem to show a
  /// sine once in some thirty times.
  template <class Interpolate>
  bool hides_in_time(double from, double third, const Interpolate& interpolate) {
    const double at = from + (2.0 - thresholds::golden_ratio) * (earlier_at_ - from);
    look(at, nullptr, interpolate, at_end_);
    const FourLooks looks{oldest_.data(),
                          at_end_.data(),
                          earlier_.data(),
                          middle_.data(),
                          ThirdDifference(from, at, earlier_at_, third),
                          is_near(earlier_at_, third),
                          resolution_ / (third - earlier_at_)};
    return judge_.any(looks,
                      [](std::size_t, const LookVariation& each) { return each.is_noise(); });
  }

  void keep_looks(std::size_t k) {
    begin_.last[k] = guards_->g[k], begin_.earlier[k] = earlier_[k], begin_.oldest[k] = oldest_[k];
  }
  void set_looks() {
    for (const std::size_t k : located_->looked) {
      guards_->g[k] = begin_.last[k], earlier_[k] = begin_.earlier[k];
      oldest_[k] = begin_.oldest[k];
    }
    earlier_at_ = begin_.earlier_at, oldest_at_ = begin_.oldest_at, may_go_back_ = false;
  }

  /// Whether a sufficient test shows that nothing happens between two evenly spaced looks. In most
  /// pieces it is the same one, because the looks before are as far apart.
  [[gnu::always_inline]] bool is_clear(double from, double to) const {
    static constexpr ClearPiece even({1.0, true, true}, {0.0, 1.0, 2.0, 3.0});
    if (!refines_) return false;
    if (pace_.is_finer_than(to - from)) return false;
    if (even_looks_ >= 3) return nothing_fired(even);
    if (earlier_at_ == never) return nothing_fired(ClearPiece());
    const TurnRange turn((to - from) / (from - earlier_at_), may_go_back_, true);
    if (oldest_at_ == never) return nothing_fired(ClearPiece(turn, {}));
    return nothing_fired(ClearPiece(turn, {oldest_at_, earlier_at_, from, to}));
  }

  /// Whether there are three looks, and the one at high_.
  bool has_four_looks() const { return earlier_at_ != never && oldest_at_ != never; }
  [[gnu::always_inline]] FourLooks four_looks(double from, double to) const {
    return {oldest_.data(),
            earlier_.data(),
            guards_->g.data(),
            high_.data(),
            ThirdDifference(oldest_at_, earlier_at_, from, to),
            is_near(from, to),
            resolution_ / (to - from)};
  }
  bool is_near(double from, double to) const { return to - from <= even_ * thresholds::step_piece; }
  [[gnu::always_inline]] bool hides(double from, double to) const {
    return has_four_looks() && judge_.hides(four_looks(from, to));
  }
  /// Whether guards look clear only, because what they read hides something.
  [[gnu::always_inline]] bool reads_hide(double from, double to) const {
    return !located_->reads.empty() && hides(from, to);
  }

  PieceJudge judge_, kept_judge_ = judge_;
  LookPace pace_, kept_pace_;
  List<double> kept_speed_;
  Looks begin_;              // those where the pieces of the step began
  double back_to_ = never;   // where that was, until shorter pieces are judged by four looks
  List<double> at_end_;      // guards at the end of an evenly spaced piece
  double even_ = 0.0;        // [s] between the evenly spaced looks
  double least_ = 0.0;       // [s] no piece is shorter
  double resolution_ = 0.0;  // [s] a rounding of the time at the end of the step
  int even_looks_ = 1;       // looks in a row that far apart
  bool refines_ = false;     // there may be looks between these
};

}  // namespace saltus
