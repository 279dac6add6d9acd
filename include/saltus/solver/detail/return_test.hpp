// Whether a scene that was stiff no longer is.
#pragma once

#include <algorithm>
#include <utility>

#include "saltus/solver/detail/stiff_thresholds.hpp"

namespace saltus {

/// How often the steps of a stiff method are checked, and up to which reach they are stable for the
/// explicit one.
struct CheckPace {
  int every;     ///< [steps] between two checks
  int first;     ///< [steps] before the first check, because order and steps still rise
  double reach;  ///< [h |lambda|]
};
inline constexpr CheckPace pace_of_bdf{thresholds::check_every, thresholds::short_stretch,
                                       thresholds::stable_reach};
inline constexpr CheckPace pace_of_radau{thresholds::check_every_of_radau,
                                         thresholds::short_stretch_of_radau,
                                         thresholds::stable_reach_of_radau};

/// The steps of a stretch. A scene is not stiff any more when |lambda| h is small for the steps h
/// of the stiff method, because these steps are stable for the explicit one (L. Petzold, SIAM J.
/// Sci. Stat. Comput. 4 (1983) 136). A check has to succeed several times in a row: twice at first,
/// and twice as often after each return that did not last, so that the methods do not alternate.
class ReturnTest {
 public:
  void begin_run() {
    forget();
    patience_ = thresholds::first_checks;
  }
  /// A restart, or a change of method.
  void forget() { longest_ = window_ = 0.0, steps_ = looked_ = passed_ = 0; }
  /// A step of length h [s].
  void add_step(double h) { longest_ = std::max(longest_, h), ++steps_; }

  int steps() const noexcept { return steps_; }
  /// [s] The longest step since the last check but one.
  double longest() const noexcept { return std::max(longest_, window_); }
  /// The last return did not last.
  void be_patient() { patience_ = std::min(2 * patience_, thresholds::most_checks); }

  /// Whether a check is due. Its window begins anew.
  bool due(const CheckPace& pace) {
    if (steps_ - looked_ < pace.every) return false;
    window_ = std::exchange(longest_, 0.0), looked_ = steps_;
    return steps_ >= pace.first;
  }
  /// A check with |lambda| [1/s]. Returns whether enough of them have succeeded.
  bool passes(double rate, const CheckPace& pace) {
    passed_ = rate * window_ < pace.reach ? passed_ + 1 : 0;
    return passed_ >= patience_;
  }

 private:
  double longest_ = 0.0;  // [s] since the last check
  double window_ = 0.0;   // [s] longest of the steps before the last check
  int steps_ = 0;         // since the last restart or change
  int looked_ = 0;        // steps_ at the last check
  int passed_ = 0, patience_ = thresholds::first_checks;
};

}  // namespace saltus
