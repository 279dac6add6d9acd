// Narrowing: from an interval in which a guard crosses to the offset of the crossing.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/guard_set.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Looks at all guards that are located together at once, and narrows an interval in which one
/// crosses: by the parabola through the last three looks (D. E. Muller, "A method for solving
/// algebraic equations using an automatic computer", Math. Tables Aids Comput. 10 (1956) 208). If
/// the parabola keeps one end unchanged, the Illinois variant of regula falsi follows, guarded by
/// bisection (K. L. Hiebert and L. F. Shampine, "Implicitly defined output points for solutions of
/// ODEs", Sandia report SAND80-0180, 1980: the vector form, earliest root first). The result is
/// always the end on the firing side, so the state there is past the crossing or exactly on it.
/// Points inside the step are offsets u from its beginning, not times: the bracket ends below
/// 2 eps u, finer than the resolution of t, so that a state reaches its surface equally well late
/// and early in a long run. Where few of many guards have crossed, the looks on the way are at
/// these few.
class Narrower {
 protected:
  struct Bracket {
    double low, high;
  };

  Narrower(Machine& machine, GuardSet& guards, const LocatedGuards& located)
      : machine_(&machine), guards_(&guards), located_(&located), x_(machine.plan().nx) {
    const Index slots = machine.plan().look_slots;
    for (auto* values : {&low_, &high_, &middle_, &third_, &noise_, &jump_, &begun_})
      values->assign(slots, 1.0);
    crossed_.reserve(low_.size()), limits_.reserve(low_.size()), few_.reserve(low_.size());
  }

  /// Computes the guards at offset u; while few are narrowed, only these.
  template <class Interpolate>
  void look(double u, const double* known, const Interpolate& interpolate,
            std::vector<double>& values) {
    if (known == nullptr) interpolate(u, x_.data());
    const double* x = known == nullptr ? x_.data() : known;
    if (few_.empty() && no_others_)
      machine_->guards(t0_ + u, x, values.data());
    else
      machine_->guards_of(few_.empty() ? located_->groups : few_groups_, t0_ + u, x, values.data());
  }

  /// Copies the values of all guards between two lists of one size. Nothing is allocated.
  static void copy_values(const List<double>& from, List<double>& to) {
    std::copy_n(from.data(), from.size(), to.data());
  }

  /// Sets the values at which the active guards fire, from their present records.
  void set_limits() {
    no_others_ = located_->groups.size() == machine_->seen_guards().groups().size();
    limits_.resize(located_->slots.size());
    std::pair<double, double>* limits = limits_.data();
    for (const std::size_t k : located_->slots) *limits++ = (*guards_)[k].limits();
  }

  bool fired(std::size_t i, const std::vector<double>& values) const {
    const double value = values[located_->slots[i]];
    return !(value > limits_[i].first && value < limits_[i].second);  // NaN and Inf fire too
  }

  /// Whether some guard has crossed at these values; if so, crossed_ says which.
  bool note_crossed(const std::vector<double>& values) {
    const std::size_t count = limits_.size();
    std::size_t i = 0;
    while (i < count && !fired(i, values)) ++i;
    if (i == count) return false;
    crossed_.clear();
    for (; i < count; ++i) {
      if (fired(i, values)) crossed_.push_back(located_->slots[i]);
    }
    return true;
  }

  /// Narrows [low, high]: no guard has fired at low, and by `high_` a guard has fired at high. On
  /// return `high_` and crossed_ belong to the high end of the bracket, the root; no guard has fired at
  /// its low end. `third_` has the guards at third_at_, another look nearby; third_at_ is infinite if
  /// there is none.
  template <class Interpolate>
  Bracket narrow(double low, double high, const Interpolate& interpolate) {
    copy_values(guards_->g, low_), copy_values(high_, begun_);
    choose_few();
    Bracket last = narrow_few({low, high}, interpolate);
    while (!few_.empty() && others_crossed(last, low, interpolate))
      last = narrow_few({low, last.low}, interpolate);
    note_ends(last.high - last.low, high - low);
    return last;
  }

  Machine* machine_;
  GuardSet* guards_;
  const LocatedGuards* located_;
  List<double> low_, high_, middle_, third_;
  double third_at_ = 0.0;
  List<double> noise_;  // of guards near their root, by the rounding of interpolants
  List<double> begun_;  // guards at the high end of the whole interval
  List<double> jump_;   // of guards that seem to jump at their root, otherwise 0
  std::vector<std::size_t> crossed_;
  std::vector<std::pair<double, double>> limits_;  // of the watched guards
  std::vector<std::size_t> few_;                   // the slots that are narrowed; empty: all
  double t0_ = 0.0;
  List<double> x_;  // the state at the last look inside a step

 private:
  /// If few of many guards have crossed by the high end, only these are narrowed.
  void choose_few() {
    few_.clear(), few_groups_.clear();
    if (crossed_.size() * thresholds::few_guards > located_->groups.size()) return;
    for (const std::size_t k : crossed_) {
      const auto at = std::ranges::lower_bound(located_->slots, k);
      few_.push_back(static_cast<std::size_t>(at - located_->slots.begin()));
      const int group = (*guards_)[k].group;
      if (few_groups_.empty() || few_groups_.back() != group) few_groups_.push_back(group);
    }
  }

  /// Few guards were narrowed to this bracket. Looks at all of them at its ends. True if others
  /// have crossed before it: then these are narrowed next.
  template <class Interpolate>
  bool others_crossed(const Bracket& last, double begun, const Interpolate& interpolate) {
    few_.clear();
    look(last.high, nullptr, interpolate, high_);
    if (last.low == begun)
      copy_values(guards_->g, low_);
    else
      look(last.low, nullptr, interpolate, low_);
    if (last.low == begun || !note_crossed(low_)) return note_crossed(high_), false;
    high_.swap(low_), copy_values(guards_->g, low_);
    third_at_ = std::numeric_limits<double>::infinity();
    choose_few();
    return true;
  }

  /// Narrows an interval to the bracket of a root.
  template <class Interpolate>
  Bracket narrow_few(Bracket in, const Interpolate& interpolate) {
    auto [low, high] = in;
    int kept = 0;       // looks in a row that kept the low (> 0) or the high (< 0) end
    double back = 1.0;  // [brackets] before exact zeros
    double weight = 1.0;
    for (int count = 0; count < thresholds::most_looks; ++count) {
      const double resolution = thresholds::bracket_roundings * thresholds::eps * high;
      if (high - low <= resolution) break;
      const bool zeros = only_exact_zeros();
      const double u = zeros ? before_zeros(low, high, back * resolution)
                       : count > thresholds::bisects_after
                           ? low + 0.5 * (high - low)
                           : next_point(low, high, weight, resolution);
      if (!(u > low && u < high)) break;
      back = zeros ? back * thresholds::plateau_growth : 1.0;
      look(u, nullptr, interpolate, middle_);
      if (few_.empty() ? note_crossed(middle_) : note_few_crossed(middle_)) {
        third_at_ = high, high = u, high_.swap(middle_);
        if (few_.empty()) choose_few();
        kept = std::max(kept, 0) + 1;
      } else {
        third_at_ = low, low = u, low_.swap(middle_);
        leave_zero();
        kept = std::min(kept, 0) - 1;
      }
      third_.swap(middle_);
      weight = next_weight(weight, kept);
    }
    return {low, high};
  }

  /// An exact zero: the next look is just before it. If there is another zero, the guard is flat.
  /// The looks then go back in growing steps, because the rounding of a state makes many such
  /// plateaus, all short; the last interval is halved to the beginning of the plateau.
  static double before_zeros(double low, double high, double back) {
    return high - back > low ? high - back : low + 0.5 * (high - low);
  }

  /// note_crossed for the few guards that are narrowed.
  bool note_few_crossed(const std::vector<double>& values) {
    const auto has_fired = [&](std::size_t i) { return fired(i, values); };
    if (std::ranges::none_of(few_, has_fired)) return false;
    crossed_.clear();
    for (const std::size_t i : few_) {
      if (has_fired(i)) crossed_.push_back(located_->slots[i]);
    }
    return true;
  }

  /// The next weight: Illinois halves the value of an end that was kept twice in a row.
  static double next_weight(double weight, int kept) {
    return kept > 1 ? weight * 0.5 : kept < -1 ? weight * 2.0 : 1.0;
  }
  /// How much steeper than in the whole interval a guard is at a jump, where the interval is so many
  /// times as long as the last bracket. A jump is steeper by that whole factor, a smooth guard not at
  /// all, and a root as that of a cube root by its power 2/3.
  static double steepness_of_jump(double narrowed) {
    if (narrowed < thresholds::jump_narrowing) return std::numeric_limits<double>::infinity();
    return std::min(thresholds::jump_steepness, std::pow(narrowed, thresholds::jump_power));
  }
  /// The values at the ends of the last bracket are the noise of a smooth guard. A guard that jumps
  /// has no noise.
  void note_ends(double last, double begun) {
    const double steepness = steepness_of_jump(begun / last);
    for (const std::size_t k : crossed_) {
      const double jump = std::abs(high_[k] - low_[k]);
      const double change = std::abs(begun_[k] - guards_->g[k]);
      const bool jumps = jump * begun > steepness * last * std::max(change, jump);
      jump_[k] = jumps ? jump : 0.0;
      noise_[k] =
          jumps ? 0.0 : thresholds::root_noise * std::max(std::abs(low_[k]), std::abs(high_[k]));
    }
  }

  /// A guard that waits and is on its armed side at low becomes armed.
  void leave_zero() {
    if (few_.empty()) {
      for (std::size_t i = 0; i < limits_.size(); ++i) leave_zero(i);
    } else {
      for (const std::size_t i : few_) leave_zero(i);
    }
  }
  void leave_zero(std::size_t i) {
    const std::size_t k = located_->slots[i];
    const Guard& guard = (*guards_)[k];
    if (!guard.waits() || guard.sign(low_[k]) != guard.side) return;
    guards_->leave_zero(k);
    limits_[i] = guard.limits();
  }

  bool only_exact_zeros() const {
    return std::ranges::all_of(crossed_, [&](std::size_t k) { return high_[k] == 0.0; });
  }

  /// The estimated crossing of the guard that seems to cross first, at least one resolution away
  /// from the ends. It is the middle if there is no estimate: for guards that jump, or that are at
  /// zero at the low end.
  double next_point(double low, double high, double weight, double resolution) const {
    if (high - low <= thresholds::last_look * resolution) return low + 0.5 * (high - low);
    double fraction = 2.0;  // part of the interval, from low
    for (std::size_t k : crossed_) {
      const Guard& guard = (*guards_)[k];
      const double a = std::abs(low_[k]) * weight, b = std::abs(high_[k]);
      const bool blind = guard.jumps || guard.waits() || !(a > 0.0) ||
                         !(a + b < std::numeric_limits<double>::infinity());
      fraction = std::min(fraction, blind           ? 0.5
                                    : weight == 1.0 ? parabola(k, low, high)
                                                    : a / (a + b));
    }
    return std::clamp(low + fraction * (high - low), low + resolution, high - resolution);
  }

  /// The zero of the parabola through low, high and the third look, as a part of the interval. If
  /// there is none, the zero of the line through low and high. Values are in units of their
  /// difference, offsets in units of the interval, because their squares may be out of range.
  double parabola(std::size_t k, double low, double high) const {
    const double unit = 1.0 / (high_[k] - low_[k]), w = (third_at_ - low) / (high - low);
    const double a = low_[k] * unit, third = third_[k] * unit - a;  // 0: a, 1: a + 1, w: a + third
    const double square = third - w, linear = w * w - third;        // both times w (w - 1), as
    const double constant = a * w * (w - 1.0);                      // is the third coefficient
    const double root = std::sqrt(linear * linear - 4.0 * square * constant);
    const double t = -0.5 * (linear + std::copysign(root, linear));
    const double near = constant / t, far = t / square;
    return near > 0.0 && near < 1.0 ? near : far > 0.0 && far < 1.0 ? far : -a;
  }

  std::vector<int> few_groups_;  // the groups of few_
  bool no_others_ = false;       // all active guards are located together
};

}  // namespace saltus
