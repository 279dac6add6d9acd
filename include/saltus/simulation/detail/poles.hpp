// Poles: a step at a loose tolerance has passed a pole of a derivative.
#pragma once

#include <memory>
#include <utility>

#include <Eigen/Core>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flow_divisors.hpp"
#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/simulation/detail/integration.hpp"

namespace saltus {

/// Looks for poles inside the steps of a run, as that of x' = 1/(0.5 - t) at t = 0.5. A long step
/// may have finite slopes on both sides of a pole, and by chance a small error estimate. But a
/// divisor of the derivative changes its sign there. Where one does, its zero is narrowed on the
/// solver's own interpolant, and the derivatives near it decide: at a pole they grow as fast as the
/// distance from it shrinks, or faster, while sin(t)/t does not grow, and 1/cbrt(t) grows less.
///
/// Nothing is looked at where tolerances are tight, because there no step passes a pole, nor where
/// no divisor can change its sign, or a derivative is a call.
class Poles {
 public:
  Poles(Machine& machine, const SimulatorOptions& options);

  /// A run begins.
  void begin();
  /// A step leaves t [s] and the state x.
  void depart(double t, const Eigen::VectorXd& x) {
    if (!loose_ || !looks()) return;
    x_ = x;
    look(t, x, now_), keep(now_);
  }
  /// Whether the step between these times [s] has passed a pole.
  bool passed(double from, double to, Integration& integration) {
    return loose_ && looks() && find(from, to, integration);
  }

  struct Pole {
    double t = 0.0;   ///< [s]
    Index state = 0;  ///< whose derivative grows most
  };
  /// The first pole that was passed.
  const Pole& pole() const noexcept { return pole_; }

 private:
  bool looks();
  bool find(double from, double to, Integration& integration);
  void look(double t, const Eigen::VectorXd& x, List<double>& values);
  void keep(const List<double>& values);
  double narrow(Index divisor, double from, double to, Integration& integration);
  bool is_pole(double t, double from, double to, Integration& integration);
  bool grows(double t, double near, Integration& integration);
  bool fills(double t, double end, Integration& integration);
  template <class Test>
  bool has_state(double t, const Test& test);
  bool derivative_at(double t, Integration& integration, Eigen::VectorXd& f);

  Machine* machine_;
  const SimulatorOptions* options_;
  bool loose_;
  int functions_ = -1;  // of the machine, of which the divisors are made
  std::shared_ptr<const FlowDivisors> divisors_;
  FlowVariables variables_;
  List<double> before_, now_, inside_;  // the divisors at looks; before_ is never zero again
  Eigen::VectorXd x_;                   // at the begin of the step
  Eigen::VectorXd f_far_, f_near_;
  Pole pole_;
};

}  // namespace saltus
