// Length and order of the next step, from the steps of a run so far.
#pragma once

#include "saltus/solver/detail/radau/convergence.hpp"
#include "saltus/solver/detail/radau/step_control.hpp"

namespace saltus::radau {

/// An accepted step. `ratio`: of its length to that of the step before, 0 if that says nothing.
struct Accepted {
  double h, error, ratio;
  bool rejected_before, jacobian_kept;
};

/// The one record of the last steps: errors, lengths, convergence.
class StepChoice {
 public:
  /// See first_stages.
  explicit StepChoice(double rtol) : usual_(first_stages(rtol)) { start(); }

  /// A new run, or a change of method.
  void start() { take(usual_); }
  /// A restart: the order stays.
  void restart() { take(order_.stages); }
  /// The next steps have this order.
  void take(int stages) { order_ = {.stages = stages, .usual = usual_}; }
  /// The last steps are no trend of the error.
  void forget_trend() { control_.forget(); }

  int stages() const { return order_.stages; }

  /// Chooses the next order, and returns the next length.
  double accept(const Accepted& step, const Convergence& newton) {
    const int stages = order_.stages;
    ++order_.steps;
    if (newton.iterations() > 1)
      order_.theta = std::max(newton.theta(), tuning::theta_memory * order_.theta);
    const double next = control_.accept(step.error, step.h, scheme_of(stages).estimate_order(),
                                        safety(newton), step.rejected_before);
    choose(step.ratio, false);
    const bool same = step.jacobian_kept && order_.stages == stages && not_worth_it(next / step.h);
    return same ? step.h : next;
  }
  /// The length after a step of length h whose error is too large.
  double reject(double error, double h, const Convergence& newton) const {
    return PredictiveControl::reject(error, h, scheme_of(order_.stages).estimate_order(),
                                     safety(newton));
  }
  /// Newton's iteration did not converge.
  void newton_failed() { choose(0.0, true); }

 private:
  double safety(const Convergence& newton) const {
    return safety_of(newton.iterations(), most_iterations(order_.stages));
  }
  void choose(double ratio, bool newton_failed) {
    order_.ratio = ratio, order_.newton_failed = newton_failed;
    const int stages = next_stages(order_);
    if (stages == order_.stages) return;
    take(stages);
    control_.forget();
  }

  PredictiveControl control_;
  int usual_;
  OrderFacts order_;
};

}  // namespace saltus::radau
