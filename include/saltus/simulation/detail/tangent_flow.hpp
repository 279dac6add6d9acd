// TangentFlow: the derivatives of the flow and of the guards by all that they read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/detail/flow_graph.hpp"
#include "saltus/plan/detail/flow_variables.hpp"
#include "saltus/simulation/detail/flow_chain.hpp"
#include "saltus/tape/switches.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus {

/// The derivatives of one guard.
struct GuardTangent {
  Eigen::VectorXd by_state;    ///< dg/dx
  double by_time = 0.0;        ///< dg/dt
  Eigen::RowVectorXd columns;  ///< dg of each column
};

/// Whether the residual of a switch with these numbers is zero at (t, x) within its rounding. A residual
/// that jumps itself, as that of floor(t) > 2.5, is not.
bool is_at_limit(const double* numbers, const GuardTangent& residual, double t, const double* x);

/// Turns derivatives at a moving time into those at a fixed time.
void fix_time(TangentProbe& probe, double t, const double* x, TangentColumns& at);

/// Where all functions of the flow are formulas or traced, its derivatives are exact: expressions
/// of the plan's graph. Where one of them is called, they are those of a FlowChain.
class TangentFlow {
 public:
  TangentFlow(const Machine& machine, TangentProbe& probe);

  /// A run begins whose columns move these parameters; the derivatives by the others are not computed.
  void begin(const ParameterMoves& moves);
  /// dxdot/dx at (t, x), and dxdot of each column at a fixed time and a fixed state,
  /// which is a column of `by`.
  void at(double t, const double* x, const TangentColumns& columns, Eigen::MatrixXd& jacobian,
          Eigen::MatrixXd& by);
  GuardTangent guard(double t, const double* x, Index slot, const TangentColumns& columns);

  /// Whether a switch of the flow (see tape/switches.hpp) is at its limit at (t, x), and stays there
  /// where the state follows the flow. Where a function is called, no switch is known.
  bool rests_at_switch(double t, const double* x, const Eigen::VectorXd& flow);
  /// Whether the derivatives of the flow jump beside (t, x) along a direction.
  bool bends(double t, const double* x, const TangentDirection& along);

  /// Whether the derivatives of the flow are exact.
  bool exact() const noexcept { return rates_.has_value(); }

  enum class Variable { x, z, y, p, t };
  /// The derivative of row `row` by one variable. For p, `index` is an entry of all parameters.
  struct Entry {
    Index row;
    Variable kind;
    Index index;
  };
  /// Derivatives of some rows as one tape.
  struct Partials {
    std::vector<Entry> entries;
    tape::Tape tape;
    Eigen::VectorXd values;
  };
  /// Those of expressions with the variables of a FlowGraph, by all that moves. Adds nodes to the graph.
  Partials partials(tape::Graph& graph, const std::vector<tape::Node>& rows, bool by_time) const;
  /// Computes them at (t, x).
  void evaluate(Partials& of, double t, const double* x);
  /// The switches of a guard, and the derivatives of their a - b.
  struct GuardSwitches {
    tape::Tape numbers;
    Partials residuals;
  };
  /// Those of the guard of a slot; null if it is called, or has none.
  GuardSwitches* switches_of_guard(Index slot);
  /// Computes one row of exact derivatives at (t, x).
  GuardTangent exact_row(Partials& all, double t, const double* x, Index row,
                         const TangentColumns& columns);
  FlowVariables& variables() noexcept { return variables_; }
  /// The number of the functions of which all of this is made.
  int functions() const noexcept { return functions_; }

  /// The exact derivatives of the rates. A derivative that is zero everywhere has no entry.
  const std::vector<Entry>& rate_entries() const { return rates_->entries; }
  /// Their values at (t, x), which last until the next call.
  const double* rates_at(double t, const double* x) {
    evaluate(*rates_, t, x);
    return rates_->values.data();
  }
  /// Makes the derivatives of the functions that the machine has now. Their number changes with them.
  int renew() {
    if (functions_ != machine_->functions()) make();
    return functions_;
  }
  /// Whether the flow is exact and has switches (see tape/switches.hpp).
  bool has_switches() const noexcept { return switches_.has_value(); }
  /// Their numbers at (t, x), which last until the next call.
  const double* switches_at(double t, const double* x);
  Index switch_count() const { return switches_ ? switches_->size() / tape::numbers_of_switch : 0; }
  /// Writes the branch of each switch at (t, x).
  void branches_at(double t, const double* x, std::vector<double>& branches);
  /// The flow at (t, x), by the expressions of which the branches are.
  Eigen::VectorXd rates_of_branch(double t, const double* x);
  /// The derivatives of a - b of a switch, which is zero at its limit.
  GuardTangent of_switch(double t, const double* x, Index number, const TangentColumns& columns) {
    return exact_row(switched().residuals, t, x, number, columns);
  }
  /// Whether the flow is known not to depend on the time itself.
  bool autonomous() const;
  /// Why a derivative of the flow was NaN since `forget_obstacle`; empty if no function says.
  std::string obstacle() const { return exact() ? std::string() : chain_->obstacle(); }
  void forget_obstacle() {
    if (chain_) chain_->forget_obstacle();
  }
  /// In words, for `Simulator::describe`.
  std::string describe() const;

 private:
  /// The flow, and a - b of each switch with its derivatives.
  struct Switched {
    tape::Tape rates;
    Partials residuals;
  };

  void make();
  Partials residuals(tape::Graph& graph, const std::vector<tape::Node>& numbers) const;
  Switched& switched();
  void exact_at(double t, const double* x, const TangentColumns& columns, Eigen::MatrixXd& jacobian,
                Eigen::MatrixXd& by);
  GuardTangent called_guard(double t, const double* x, Index slot, const TangentColumns& columns);
  void difference_by_time(double t, const double* x, Index slot, double& by_time);
  FlowChain& chain();

  const Machine* machine_;
  TangentProbe* probe_;
  FlowVariables variables_;
  bool made_ = false;
  int functions_ = -1;              // of the machine, when the tapes were made
  std::vector<Index> moved_;        // the entries of p for which they were made
  std::optional<FlowChain> chain_;  // made where a function is called
  bool reads_time_ = true;
  std::optional<Partials> rates_, guards_;
  std::optional<tape::Tape> switches_;  // of the rates, if they have any
  Eigen::VectorXd switch_values_;
  std::optional<Switched> switched_;                              // made where a branch changes
  std::map<Index, std::optional<GuardSwitches>> guard_switches_;  // by slot, of guards that jumped
  std::vector<Index> row_of_slot_;  // of `guards_`; -1: the guard is called
};

}  // namespace saltus
