// TurnRange: whether the parabola through three looks at a guard turns in a part of a step.
#pragma once

namespace saltus {

/// Three looks, and the part in which a search can find a dip: the piece between the last two, and
/// the one before where that can be searched, too. The parabola errs by a part of a piece. So where
/// no other look will show a dip at an end of the part, a vertex up to one piece beyond counts: the
/// slope of the guard at that end decides.
class TurnRange {
 public:
  /// `ratio` is the length of the last piece over that of the one before. `goes_back` says that the
  /// piece before is searched, `ends` that nothing is searched after the last one.
  constexpr TurnRange(double ratio, bool goes_back, bool ends) {
    // The slope w last pieces after the last look, times a positive number, is
    //     rise (1 + (2 + 2 w) ratio) - earlier_rise (1 + 2 w) ratio^2,
    // and w last pieces before the second look, with -(1 + 2 w) for 1 + 2 w, and so on.
    const double w = ends ? 1.0 : 0.0, square = ratio * ratio;
    late_ = 1.0 + (2.0 + 2.0 * w) * ratio, late_earlier_ = (1.0 + 2.0 * w) * square;
    early_ = goes_back ? -1.0 : 1.0 - 2.0 * ratio;
    early_earlier_ = goes_back ? ratio * (2.0 + ratio) : 3.0 * square;
  }
  /// No vertex counts, where fewer than three looks are known.
  constexpr TurnRange() = default;

  /// Whether a guard that rises so much from look to look, to its side, has its vertex there: it
  /// falls where the part begins, and rises where it ends.
  constexpr bool contains(double earlier_rise, double rise) const {
    return rise * late_ > earlier_rise * late_earlier_ &&
           rise * early_ < -(earlier_rise * early_earlier_);
  }

 private:
  double late_ = 0.0, late_earlier_ = 0.0, early_ = 0.0, early_earlier_ = 0.0;
};

}  // namespace saltus
