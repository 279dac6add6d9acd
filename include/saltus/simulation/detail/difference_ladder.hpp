// DifferenceLadder: which of several shifts give the derivatives of numbers.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "saltus/base/view.hpp"

namespace saltus {

/// Values of a function at a shift and at twice it, to both sides.
struct MovedValues {
  double shift = 0.0;
  Eigen::VectorXd up, down, far_up, far_down;
};

/// The derivatives of several numbers, each from those shifts that suit it. A rung is a shift and
/// twice it: if both differences agree and the number has no kink, its derivative is settled.
class DifferenceLadder {
 public:
  using Centre = std::function<const Eigen::VectorXd*()>;  ///< the values without a shift, or null

  /// A new derivative of `size` numbers along a direction whose largest entry is `direction`.
  void begin(Index size, double direction) {
    numbers_.assign(static_cast<std::size_t>(size), {});
    direction_ = direction, first_ = true;
  }
  void look(const MovedValues& at, const Centre& centre);
  /// Whether a number has no two differences that agree.
  bool open() const {
    return std::ranges::any_of(numbers_, [](const Number& number) { return !number.settled; });
  }
  /// Whether a number is settled, but rounding hides its derivative.
  bool blurred() const {
    return std::ranges::any_of(numbers_, [](const Number& number) { return number.blur > 0.0; });
  }
  /// NaN for the numbers that are open. True if there are none.
  bool write(double* out) const {
    for (const Number& number : numbers_)
      *out++ = number.settled ? number.value : std::numeric_limits<double>::quiet_NaN();
    return !open();
  }

 private:
  struct Number {
    bool settled = false;
    double value = 0.0, error = 0.0;  // of the best rung
    double blur = 0.0;                // of rounding, where it is too large
    double last = 0.0;                // the difference of the rung before
    int falls = 0;                    // rungs in which the difference fell towards 0
  };
  struct Rung {
    double near, wide;   // the differences to the shift and to twice it
    double most, noise;  // of the value, and of a difference by its rounding
    double value() const { return near + (near - wide) / 3.0; }
  };
  void look(Number& number, const Rung& rung, bool smooth);
  void settle(Number& number, double value, double error, double blur);
  static bool smooth(const MovedValues& at, Index i, const Rung& rung, const Centre& centre);
  void forgive(const MovedValues& at);

  std::vector<Number> numbers_;
  double direction_ = 1.0;
  bool first_ = true;
};

}  // namespace saltus
