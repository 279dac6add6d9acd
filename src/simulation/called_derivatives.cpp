// CalledDerivatives: a declared Jacobian, and differences for the rest.
#include "saltus/simulation/detail/called_derivatives.hpp"

#include <algorithm>

#include "saltus/simulation/detail/declared_derivatives.hpp"

namespace saltus {

namespace {

/// Whether an input of a leaf shows this entry of the continuous state.
bool is_input(const PlanLeaf& leaf, Index entry) {
  return std::ranges::any_of(leaf.input_places, [entry](const Place& place) {
    return place.space == Space::x && place.offset <= entry && entry < place.offset + place.size;
  });
}

}  // namespace

/// The declared Jacobian has a column for each state of the leaf. A state that the leaf also reads as
/// an input is differenced, because inputs count as constants there.
Eigen::MatrixXd CalledDerivatives::of(const LeafFunction& function, double t, const Moves& moves) {
  differenced_ = false, obstacle_.clear();
  const auto count = static_cast<Index>(function.reads.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(function.size, count);
  if (function.call == nullptr) return all;
  if (function.declares_derivatives()) return declared(function, t, moves);
  const PlanLeaf& leaf = machine_->plan().leaf(function.leaf);
  const Eigen::MatrixXd declared = function.jacobian ? jacobian(function, t) : Eigen::MatrixXd();
  for (Index k = 0; k < count; ++k) {
    const ReadValue& read = nth(function.reads, k);
    if (!moves(read)) continue;
    const Index own = read.space == Space::x ? read.index - leaf.x : -1;
    const bool known = 0 <= own && own < declared.cols() && declared.col(own).allFinite() &&
                       !is_input(leaf, read.index);
    if (known)
      all.col(k) = declared.col(own);
    else
      difference(function, t, read, all.col(k).data());
  }
  return all;
}

/// A value that the leaf reads in several ways has the sum of their columns.
Eigen::MatrixXd CalledDerivatives::declared(const LeafFunction& function, double t,
                                            const Moves& moves) {
  const PlanLeaf& leaf = machine_->plan().leaf(function.leaf);
  const Eigen::MatrixXd own = declared_derivatives(
      leaf, *function.derivatives, machine_->at(function.leaf, t, machine_->x.data()),
      function.size, function.name);
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(function.size, static_cast<Index>(function.reads.size()));
  each_column(leaf, [&](Index column, const Place& place) {
    const ReadValue read{place.space, place.offset};
    const auto found = std::ranges::lower_bound(function.reads, read);
    if (found == function.reads.end() || *found != read || !moves(read)) return;
    all.col(found - function.reads.begin()) += own.col(column);
  });
  return all;
}

Eigen::MatrixXd CalledDerivatives::jacobian(const LeafFunction& function, double t) {
  const ContinuousState& state = *function.jacobian.state;
  const LeafSystem& system = *machine_->plan().leaf(function.leaf).system;
  const At at = machine_->at(function.leaf, t, machine_->x.data());
  const Index n = function.size;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  if (state.jacobian) {
    state.jacobian(system, at, MatrixRef(all.data(), n, n));
    return all;
  }
  Eigen::VectorXd values(static_cast<Index>(state.sparsity->size()));
  state.sparse_jacobian(system, at, VectorRef(values.data(), values.size()));
  for (Index k = 0; k < values.size(); ++k)
    all(nth(*state.sparsity, k).row, nth(*state.sparsity, k).column) = values[k];
  return all;
}

void CalledDerivatives::difference(const LeafFunction& function, double t, const ReadValue& read,
                                   double* out) {
  const LeafSystem& system = *machine_->plan().leaf(function.leaf).system;
  const auto value = [&](Machine& probe, double, double* to) {
    (*function.call)(system, probe.at(function.leaf, t, probe.x.data()),
                     VectorRef(to, function.size));
  };
  probe_->derivative(machine_->x.data(), along(read), function.size, value, out);
  differenced_ = true;
  if (obstacle_.empty()) obstacle_ = probe_->obstacle();
}

TangentDirection CalledDerivatives::along(const ReadValue& read) {
  unit_x_.setZero(), unit_z_.setZero(), unit_y_.setZero();
  if (read.space == Space::p) {
    unit_p_ = {read.index, 1.0};
    return {.p = {&unit_p_, 1}};
  }
  Eigen::VectorXd& unit = read.space == Space::x   ? unit_x_
                          : read.space == Space::z ? unit_z_
                                                   : unit_y_;
  unit[read.index] = 1.0;
  return {.x = unit_x_.data(), .z = unit_z_.data(), .y = unit_y_.data()};
}

}  // namespace saltus
