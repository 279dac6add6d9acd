// FlowSwitches: where a branch of the flow changes without an event, and how that moves.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// The flow jumps from f- to f+ at a time tau, where the state goes on. With the derivatives S of the
/// state and the residual r of the branch, tau moves by dtau = -(r_x S + r_p) / (r_x f- + r_t), and
/// S+ = S + (f- - f+) dtau.
struct FlowJump {
  Eigen::VectorXd by;         ///< f- - f+
  Eigen::RowVectorXd dtau;    ///< of each column, beyond its movement; NaN: there is none
  const char* obstacle = "";  ///< why
};

/// Looks at the comparisons, steps and remainders of a flow whose derivatives are exact. A change of a
/// branch, by the time or by the state, is narrowed to two neighbouring times, on the dense output. A
/// kink is no jump.
class FlowSwitches {
 public:
  using StateAt = std::function<Eigen::VectorXd(double t)>;
  /// Neighbouring times [s] with different branches.
  struct Change {
    double before, after;
  };

  FlowSwitches(const Machine& machine, const SimulatorOptions& options, TangentFlow& flow)
      : machine_(&machine), options_(&options), flow_(&flow) {}

  /// A run begins.
  void begin() { rates_.setZero(machine_->plan().nx); }
  bool any() const noexcept { return flow_->has_switches(); }

  /// The changes within a step that were found, in the order of time.
  std::vector<Change> changes(double from, double to, const StateAt& state);
  /// Whether the flow jumps at a change: at a kink it does not.
  bool is_jump(const Change& at, const StateAt& state);
  /// What a jump is, with these columns before it.
  FlowJump jump(const Change& at, const StateAt& state, const TangentColumns& columns);
  /// The jump of the flow within some roundings of t, on the way through the state x; none if there is
  /// none.
  std::optional<FlowJump> beside(double t, const double* x, const TangentColumns& columns);

 private:
  void narrow(double from, double to, const StateAt& state, std::vector<Change>& found);
  bool is_jump(const Eigen::VectorXd& f_minus, const Eigen::VectorXd& f_plus);
  bool is_at_limit(Index number, double t, const double* x, const GuardTangent& residual);
  void take(Index number, double t, const double* x, const Eigen::VectorXd& f_minus,
            const Eigen::VectorXd& f_plus, const GuardTangent& residual,
            const TangentColumns& columns, FlowJump& jump, bool& first);
  bool passes(const GuardTangent& residual, Index number, double t, const double* x,
              const Eigen::VectorXd& f_minus, const Eigen::VectorXd& f_plus,
              const TangentColumns& columns);

  const Machine* machine_;
  const SimulatorOptions* options_;
  TangentFlow* flow_;
  Eigen::VectorXd rates_;  // the largest of each derivative so far
  std::vector<double> here_, there_, middle_;
};

}  // namespace saltus
