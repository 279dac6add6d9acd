// PassTangents: the derivatives of the states to come of a pass, as Transition has the values.
#pragma once

#include "saltus/simulation/detail/called_tangents.hpp"

namespace saltus {

/// Every function that a pass calls maps the derivatives of the states of its block on, in the order
/// of the calls. `commit` makes them the present ones.
class PassTangents {
 public:
  PassTangents(const Machine& machine, TangentProbe& probe, const TangentColumns& columns)
      : machine_(&machine), columns_(&columns), called_(machine, probe, columns, next_) {}
  PassTangents(const PassTangents&) = delete;  // `called_` reads the columns to come

  /// An instant begins at t [s].
  void open(double t) { called_.open(t); }
  /// A pass begins: the columns to come are the present ones.
  void begin() { next_.x = columns_->x, next_.z = columns_->z; }
  /// A reset map or an update, or that of a delivery, is about to be called.
  template <class Called>
  void call(const Called& call, const Transition::Seen& seen) {
    write(machine_->plan().leaf(call.leaf), called_.of(call, seen));
  }
  void commit(TangentColumns& columns) const { columns.x = next_.x, columns.z = next_.z; }

  CalledTangents& called() noexcept { return called_; }
  NextColumns& next() noexcept { return next_; }
  const NextColumns& next() const noexcept { return next_; }

 private:
  void write(const PlanLeaf& leaf, const Eigen::MatrixXd& by) {
    next_.x.middleRows(leaf.x, leaf.nx) = by.topRows(leaf.nx);
    next_.z.middleRows(leaf.z, leaf.nz) = by.bottomRows(leaf.nz);
  }

  const Machine* machine_;
  const TangentColumns* columns_;
  NextColumns next_;
  CalledTangents called_;
};

}  // namespace saltus
