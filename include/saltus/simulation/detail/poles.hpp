// Poles: a step at a loose tolerance has passed a pole of a derivative.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <utility>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flow_divisors.hpp"
#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/simulation/detail/integration.hpp"

namespace saltus {

/// Looks for poles in time inside the steps of a run, as that of x' = 1/(0.5 - t) at t = 0.5. A long
/// step may have finite slopes on both sides of a pole, and by chance a small error estimate. But a
/// divisor of the derivative changes its sign there. Where one does, its zero is narrowed, and the
/// derivatives near it decide. Their area, |f| times the distance, stays as large as in the rest of
/// the step at a pole of order one, or grows. That of 1/cbrt(t) and of sin(t)/t shrinks with the
/// distance; that of a numerator that should vanish there is as small as its error.
///
/// Only divisors of the time alone are looked at: the sign of one that a state moves is as uncertain
/// as that state. A run whose tolerances are tight has no Poles, because its steps hardly ever pass
/// one; and nothing is looked at where a derivative is a call.
class Poles {
 public:
  /// Whether steps may pass a pole at these tolerances.
  static bool may_be_passed(const SimulatorOptions& options);

  Poles(Machine& machine, const SimulatorOptions& options);

  /// A run begins.
  void begin();
  /// A step leaves t [s] and the state x.
  void depart(double t, const Eigen::VectorXd& x) {
    if (!looks()) return;
    remember(t, x);
    look(t, now_), keep(now_);
  }
  /// Whether the step between these times [s] has passed a pole.
  bool passed(double from, double to, Integration& integration) {
    return looks() && find(from, to, integration);
  }

  struct Pole {
    double t = 0.0;   ///< [s]
    Index state = 0;  ///< whose derivative grows most
  };
  /// The first pole that was passed.
  const Pole& pole() const noexcept { return pole_; }
  /// The state that the last step left.
  const Eigen::VectorXd& departed_from() const noexcept { return x_; }

 private:
  /// Where a step began.
  struct Departed {
    double t = -std::numeric_limits<double>::infinity();
    Eigen::VectorXd x = {};
  };

  bool looks();
  bool find(double from, double to, Integration& integration);
  void look(double t, List<double>& values);
  void keep(const List<double>& values);
  void remember(double t, const Eigen::VectorXd& x);
  double narrow(Index divisor, double from, double to);
  bool is_pole(double t, double from, double to, Integration& integration);
  bool side_shows(double t, double end, double least, Integration& integration);
  bool earlier_steps_show(double t, double least);
  bool stays_large(double t);
  bool area(double t, double at, const Eigen::VectorXd& x, Eigen::VectorXd& out);

  Machine* machine_;
  const SimulatorOptions* options_;
  int functions_ = -1;  // of the machine, of which the divisors are made
  std::shared_ptr<const FlowDivisors> divisors_;
  FlowVariables variables_;
  List<double> before_, now_, inside_;  // the divisors at looks; before_ is never zero again
  std::array<Departed, 32> departed_;   // the last steps
  std::size_t newest_ = 0;
  Eigen::VectorXd x_;  // at the begin of the step
  Eigen::VectorXd area_, area_far_;
  Pole pole_;
};

}  // namespace saltus
