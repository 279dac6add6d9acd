// ChainRule: the derivatives of the rates and of the signals of a plan, from function to function.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/simulation/detail/called_derivatives.hpp"

namespace saltus {

/// The values by which ChainRule differentiates: all continuous states, then these.
struct LinearColumns {
  ParameterMoves parameters;  ///< of each column that is a parameter
  List<Index> of_signal;      ///< the column of each entry of y that is a fixed input, or -1
  Index size = 0;             ///< the number of columns
};

/// Multiplies the derivatives of the functions of a plan along its wires (the chain rule, forward: A.
/// Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, section 3.1). A function with a
/// formula has exact derivatives. A called one has those that are declared, and central differences by
/// each other value that it reads.
/// Truths, modes, discrete states and sampled signals are constant.
class ChainRule {
 public:
  /// Differentiates the rates, the recorded signals, and the guards that have an effect.
  ChainRule(Machine& machine, LinearColumns columns);

  /// An entry of a relation that has the other truth; -1: none.
  struct Forced {
    int node = -1;
    Index entry = 0;
  };
  /// Parameters of blocks move so from now on.
  void set_parameters(ParameterMoves moves) { columns_.parameters = std::move(moves); }
  /// Computes all of them at (t, x) of the machine.
  void at(double t, const Forced& forced);

  // --- what `at` computed
  const Eigen::VectorXd& rates() const { return rates_; }
  const Eigen::MatrixXd& rates_by() const { return rates_by_; }
  /// The value of a node, and its derivatives.
  Eigen::VectorXd value(int node) const;
  Eigen::MatrixXd by(int node) const;
  /// Why a derivative is NaN, or doubtful; empty if all is well.
  const std::string& obstacle() const { return obstacle_; }

  /// A guard, or the guard of a relation, with its derivatives.
  struct Level {
    Eigen::VectorXd value;
    Eigen::MatrixXd by;
  };
  Level level(const LeafFunction& function);
  /// The same of a relation.
  Level relation(int node) { return level(*functions_[node]); }

  /// The relations and opaque booleans that decide a rate or a recorded signal.
  const std::vector<int>& truths() const { return truths_; }
  /// Whether a called boolean has another value beside the present state.
  bool jumps_here(int node);
  /// The called functions that were differentiated by differences.
  std::vector<std::string> called() const;

 private:
  enum class Follows { nothing, parameters, all };

  Machine& machine_;
  const Plan& plan_;
  LinearColumns columns_;
  TangentProbe probe_;
  CalledDerivatives of_called_;
  FlowVariables variables_;
  double t_ = 0.0;
  Follows follows_ = Follows::all;  // of the function under way
  std::vector<int> order_, truths_;
  List<char> wanted_;                            // whether a node reaches a rate or a signal
  List<std::optional<LeafFunction>> functions_;  // of the nodes in order_
  List<LeafFunction> odes_;
  Eigen::MatrixXd y_;  // the derivatives of all signals
  Eigen::VectorXd rates_, values_;
  Eigen::MatrixXd rates_by_;
  std::vector<std::string> called_;
  std::string obstacle_;

  Follows follows(const Node& node) const;
  void evaluate(int node, const Forced& forced);
  void call(const LeafFunction& function, double* out);
  bool moves(const ReadValue& read) const;
  void add(const ReadValue& read, double value, Eigen::Ref<Eigen::RowVectorXd> row) const;
  Eigen::MatrixXd derivative(const LeafFunction& function);
  Eigen::MatrixXd exact(const LeafFunction& function);
  Eigen::MatrixXd differences(const LeafFunction& function);
  bool has_kink(const LeafFunction& function);
  double value_of(const ReadValue& read) const;
  TangentDirection along(const ReadValue& read) { return of_called_.along(read); }
};

}  // namespace saltus
