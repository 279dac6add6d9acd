// CalledTangents: the derivatives of what the functions of blocks compute in an instant.
#pragma once

#include <functional>
#include <string>

#include "saltus/simulation/detail/inputs_before.hpp"
#include "saltus/simulation/detail/transition.hpp"

namespace saltus {

/// The derivatives of the states that the pass to come commits.
struct NextColumns {
  Eigen::MatrixXd x, z;
};

/// The priority of an execution; null: it has none.
struct PriorityOf {
  const NumberOf* priority;
  int leaf;
  Index entry;
  std::string event;
};

/// Differentiates one call. A function sees the present signals, and the states of its own block as
/// the earlier functions of the pass have written them. Declared derivatives are taken where there are
/// some, else differences along each column. It reads the columns and writes none.
class CalledTangents {
 public:
  /// The columns, and those to come, stay with their owners.
  CalledTangents(const Machine& machine, TangentProbe& probe, const TangentColumns& columns,
                 const NextColumns& next)
      : machine_(&machine), probe_(&probe), columns_(&columns), next_(&next) {}

  /// An instant begins at t [s]: the machine has the values before it, the columns belong to its time.
  void open(double t);
  double time() const noexcept { return t_; }  ///< [s] of the instant

  /// The derivatives of all states of the block that a reset map or an update writes: a row for each
  /// continuous state, then one for each discrete state.
  Eigen::MatrixXd of(const Transition::Call& call, const Transition::Seen& seen);
  /// The same for a delivery.
  Eigen::MatrixXd of(const Transition::Arrival& arrival, const Transition::Seen& seen);
  /// The derivatives of a number that a function computes from what a reset map would see.
  Eigen::RowVectorXd of(const NumberOf& number, const Transition::Seen& seen);
  /// A priority sees the present states, as Executions::priority_of.
  Eigen::RowVectorXd of(const PriorityOf& one);

 private:
  /// The probe is moved by `shift` along a column.
  struct MovedAlong {
    Machine* probe;
    Index column;
    double shift;
  };
  using OnSeen = std::function<void(const MovedAlong& by, At& at, double* to)>;
  Eigen::MatrixXd of_seen(const Transition::Seen& seen, Index rows, const OnSeen& function);
  Eigen::MatrixXd of_declared(const Transition::Call& call, const Transition::Seen& seen,
                              const DerivativesFunction& derivatives);
  Eigen::MatrixXd values_of(const PlanLeaf& leaf, Index count) const;

  const Machine* machine_;
  TangentProbe* probe_;
  const TangentColumns* columns_;
  const NextColumns* next_;
  InputsBefore inputs_before_;
  double t_ = 0.0;  // [s] of the instant
};

}  // namespace saltus
