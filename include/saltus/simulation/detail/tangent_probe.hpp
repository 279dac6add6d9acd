// TangentProbe: derivatives of functions of a machine along a direction, by central differences.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// How the values of a machine change with one parameter.
struct TangentDirection {
  double t = 0.0;                                         ///< of the time
  const double *x = nullptr, *z = nullptr, *y = nullptr;  ///< null: zero
  Index parameter = -1;                                   ///< an entry of p that changes by 1
};

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

/// A second machine beside that of a run. It takes the values of the run, moved along a direction
/// to both sides, and so the machine of the run is never touched.
class TangentProbe {
 public:
  explicit TangentProbe(const Machine& machine)
      : machine_(&machine), probe_(machine.shared_plan()) {
    begin();
  }
  /// A run begins: no size is known.
  void begin();

  /// The machine with the values of the run, moved by `shift` along the direction.
  Machine& at(const double* x, const TangentDirection& along, double shift);
  /// The same without a shift.
  Machine& at(const double* x) { return at(x, {}, 0.0); }

  /// Notes how large the values are, and how long a step is [s].
  void note(const double* x, double step);

  /// d out along the direction at (t, x). `read(machine, shift, out)` computes `size` numbers on a
  /// machine that is moved; the time and all that the machine does not have it moves by itself. NaN
  /// where no derivative is found.
  template <class Read>
  void derivative(const double* x, const TangentDirection& along, Index size, const Read& read,
                  double* out) {
    const auto value = [&](double shift, double* to) { read(at(x, along, shift), shift, to); };
    search(x, along, size, std::ref(value), out);
  }
  /// Why the last derivative has a NaN; empty if it has none.
  const std::string& obstacle() const noexcept { return obstacle_; }

  /// dxdot along the direction. States at rest do not move.
  void flow(double t, const double* x, const TangentDirection& along, double* out);
  /// The derivative itself, without a shift.
  Eigen::VectorXd flow(double t, const double* x);

 private:
  using Value = std::function<void(double shift, double* out)>;
  void search(const double* x, const TangentDirection& along, Index size, const Value& value,
              double* out);
  void rung(double shift, const Value& value);
  void climb_down(double shift, const Value& value);
  void clear_up(double shift, double from, const Value& value);
  bool found(double shift, const Value& value, Eigen::VectorXd& out);
  double shift_of(const double* x, const TangentDirection& along, double least) const;
  void let_rest(double* xdot) const;

  const Machine* machine_;
  Machine probe_;
  Eigen::VectorXd x_sizes_, z_sizes_, y_sizes_;  // the largest of each value so far
  double step_ = 0.0;                            // [s] the longest so far
  MovedValues moved_;
  Eigen::VectorXd centre_;
  bool has_centre_ = false;
  DifferenceLadder ladder_;
  std::string raised_, obstacle_;
};

}  // namespace saltus
