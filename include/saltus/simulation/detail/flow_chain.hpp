// FlowChain: the derivatives of a flow with called functions, from function to function.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/simulation/detail/called_derivatives.hpp"

namespace saltus {

/// Multiplies the derivatives of functions along the wires, as ChainRule does, at any (t, x) of a run:
/// truths and held signals keep their values. A function with a formula has exact derivatives; only
/// those that are called, and whose derivatives are not declared, have differences.
class FlowChain {
 public:
  FlowChain(const Machine& machine, const TangentProbe& sizes);

  /// dxdot/dx at (t, x), and dxdot of each column at a fixed time and a fixed state.
  void at(double t, const double* x, const TangentColumns& columns, Eigen::MatrixXd& jacobian,
          Eigen::MatrixXd& by);
  /// The same of the guard in this slot.
  void guard(double t, const double* x, Index slot, const TangentColumns& columns,
             Eigen::VectorXd& by_state, Eigen::RowVectorXd& by);

  /// Why a derivative was NaN, since `forget_obstacle`; empty if none was.
  const std::string& obstacle() const noexcept { return obstacle_; }
  void forget_obstacle() { obstacle_.clear(); }
  /// The derivative of the guard in this slot by the time, if it is declared and nothing else that the
  /// guard reads moves with the time.
  std::optional<double> guard_by_time(double t, Index slot);

  /// The called functions of the flow whose derivatives are declared, or not.
  std::vector<std::string> called(bool declared) const;

 private:
  struct OfNode {
    int node;
    LeafFunction function;
  };
  const LeafFunction& guard_of(Index slot, Index& row) const;
  static std::vector<OfNode> functions_of(const Plan& plan, const std::vector<int>& nodes);
  void set(const double* x, const TangentColumns& columns);
  void evaluate(const std::vector<OfNode>& nodes, double t);
  Eigen::MatrixXd derivative(const LeafFunction& function, double t);
  Eigen::MatrixXd exact(const LeafFunction& function, double t);
  std::span<const ParameterMoves::Column> columns_of(Index parameter) const;
  void add(const ReadValue& read, double value, Index row, Eigen::MatrixXd& by) const;
  bool moves(const ReadValue& read) const;

  const Machine* run_;
  const TangentProbe* sizes_;
  Machine machine_;
  TangentProbe probe_;
  CalledDerivatives of_called_;
  FlowVariables variables_;
  std::vector<OfNode> for_rates_, for_guards_;
  std::vector<LeafFunction> rates_, guards_;
  List<int> guard_of_slot_;  // -1: none
  std::shared_ptr<const ParameterMoves> p_;
  Eigen::MatrixXd z_, y_;  // the derivatives of discrete states and signals
  Index count_ = 0;        // columns: the states, then those of the parameters
  std::string obstacle_;
};

}  // namespace saltus
