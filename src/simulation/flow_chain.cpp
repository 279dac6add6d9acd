// FlowChain: the walk along the wires of a flow.
#include "saltus/simulation/detail/flow_chain.hpp"

#include <algorithm>

#include "saltus/simulation/detail/declared_derivatives.hpp"

namespace saltus {

std::vector<FlowChain::OfNode> FlowChain::functions_of(const Plan& plan,
                                                       const std::vector<int>& nodes) {
  std::vector<OfNode> all;
  for (const int i : nodes) {
    const Node& node = plan.node(i);
    if (!node.view && !node.relation) all.push_back({i, function_of_node(plan, i)});
  }
  return all;
}

FlowChain::FlowChain(const Machine& machine, const TangentProbe& sizes)
    : run_(&machine),
      sizes_(&sizes),
      machine_(machine.shared_plan()),
      probe_(machine_),
      of_called_(machine_, probe_),
      variables_(machine_),
      for_rates_(functions_of(machine.plan(), machine.plan().needs.derivatives)),
      for_guards_(functions_of(machine.plan(), machine.plan().needs.guards)),
      guard_of_slot_(machine.plan().guard_slots, -1) {
  const Plan& plan = machine.plan();
  for (const int leaf : plan.odes) rates_.push_back(function_of_rates(plan, leaf));
  for (const GuardGroup& group : plan.guards) {
    if (group.is_opaque()) continue;
    for (Index k = 0; k < group.size; ++k)
      guard_of_slot_[group.slot + k] = static_cast<int>(guards_.size());
    guards_.push_back(group.is_crossing() ? function_of_guard(plan, group)
                                          : function_of_node(plan, group.index));
  }
}

/// The values of the run at the state x. The columns are the states, then those of the parameters.
void FlowChain::set(const double* x, const TangentColumns& columns) {
  const Index n = machine_.plan().nx, m = columns.size();
  machine_.x = VectorView(x, n);
  machine_.z = run_->z, machine_.y = run_->y, machine_.p = run_->p, machine_.modes = run_->modes;
  probe_.take(sizes_->sizes());
  count_ = n + m;
  z_.setZero(machine_.z.size(), count_), y_.setZero(machine_.y.size(), count_);
  z_.rightCols(m) = columns.z, y_.rightCols(m) = columns.y;
  p_ = columns.p;
}

/// The values of nodes, and their derivatives. A truth that is computed between instants is constant.
void FlowChain::evaluate(const std::vector<OfNode>& nodes, double t) {
  const Plan& plan = machine_.plan();
  for (const auto& [number, function] : nodes) {
    const Place& place = plan.node(number).place;
    (*function.call)(*plan.leaf(function.leaf).system,
                     machine_.at(function.leaf, t, machine_.x.data()),
                     VectorRef(machine_.signal(number), place.size));
    auto rows = y_.middleRows(place.offset, place.size);
    if (plan.node(number).boolean)
      rows.setZero();
    else
      rows = derivative(function, t);
  }
}

void FlowChain::at(double t, const double* x, const TangentColumns& columns,
                   Eigen::MatrixXd& jacobian, Eigen::MatrixXd& by) {
  set(x, columns);
  evaluate(for_rates_, t);
  for (const LeafFunction& function : rates_) {
    const Index first = machine_.plan().leaf(function.leaf).x;
    const Eigen::MatrixXd rows = derivative(function, t);
    jacobian.middleRows(first, function.size) = rows.leftCols(jacobian.cols());
    by.middleRows(first, function.size) = rows.rightCols(by.cols());
  }
  for (Index i = 0; i < jacobian.rows() && run_->resting().any(); ++i)
    if (run_->resting().rests(i)) jacobian.row(i).setZero(), by.row(i).setZero();
}

const LeafFunction& FlowChain::guard_of(Index slot, Index& row) const {
  const int number = guard_of_slot_[slot];
  row = 0;
  while (slot - row > 0 && guard_of_slot_[slot - row - 1] == number) ++row;
  return nth(guards_, number);
}

std::optional<double> FlowChain::guard_by_time(double t, Index slot) {
  Index row = 0;
  const LeafFunction& function = guard_of(slot, row);
  if (!function.declares_derivatives()) return {};
  const Plan& plan = machine_.plan();
  for (const OfNode& one : for_guards_) {
    const Place& place = plan.node(one.node).place;
    if (std::ranges::binary_search(function.reads, ReadValue{place.space, place.offset})) return {};
  }
  const At at = machine_.at(function.leaf, t, machine_.x.data());
  return declared_derivatives(plan.leaf(function.leaf), *function.derivatives, at, function.size,
                              function.name)
      .col(Derivatives::columns(at) - 1)[row];
}

void FlowChain::guard(double t, const double* x, Index slot, const TangentColumns& columns,
                      Eigen::VectorXd& by_state, Eigen::RowVectorXd& by) {
  set(x, columns);
  evaluate(for_guards_, t);
  Index row = 0;
  const LeafFunction& function = guard_of(slot, row);
  const Eigen::RowVectorXd found = derivative(function, t).row(row);
  by_state = found.head(by_state.size());
  by = by_state.transpose() * columns.x + found.tail(columns.size());
}

bool FlowChain::moves(const ReadValue& read) const {
  if (read.space == Space::x) return true;
  if (read.space == Space::p) return !columns_of(read.index).empty();
  return !(read.space == Space::z ? z_ : y_).row(read.index).isZero(0.0);
}

/// The columns that move a parameter.
std::span<const ParameterMoves::Column> FlowChain::columns_of(Index parameter) const {
  if (!p_) return {};
  return p_->of_entry(parameter);
}

/// Adds the derivatives of a value that a function reads, times that of the function by the value.
void FlowChain::add(const ReadValue& read, double value, Index row, Eigen::MatrixXd& by) const {
  if (read.space == Space::x) by(row, read.index) += value;
  if (read.space == Space::z) by.row(row) += value * z_.row(read.index);
  if (read.space == Space::y) by.row(row) += value * y_.row(read.index);
  if (read.space != Space::p) return;
  const Index first = machine_.plan().nx;
  for (const auto& column : columns_of(read.index))
    by(row, first + column.number) += value * column.by;
}

Eigen::MatrixXd FlowChain::derivative(const LeafFunction& function, double t) {
  if (function.call == nullptr) return Eigen::MatrixXd::Zero(function.size, count_);
  if (function.partials) return exact(function, t);
  const Eigen::MatrixXd each =
      of_called_.of(function, t, [this](const ReadValue& read) { return moves(read); });
  if (!of_called_.obstacle().empty() && obstacle_.empty()) obstacle_ = of_called_.obstacle();
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(function.size, count_);
  for (Index k = 0; k < each.cols(); ++k)
    for (Index i = 0; i < function.size; ++i)
      if (each(i, k) != 0.0) add(nth(function.reads, k), each(i, k), i, by);
  return by;
}

Eigen::MatrixXd FlowChain::exact(const LeafFunction& function, double t) {
  const LeafPartials& partials = *function.partials;
  Eigen::VectorXd values(partials.tape.size());
  variables_.at(t, machine_.x.data(),
                [&](const At& at) { partials.tape.evaluate(at, values.data()); });
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(function.size, count_);
  for (std::size_t e = 0; e < partials.entries.size(); ++e) {
    const auto& [i, number] = partials.entries[e];
    const ReadValue& read = function.reads[number];
    const double value = values[function.size + static_cast<Index>(e)];
    if (value != 0.0 && moves(read)) add(read, value, i, by);
  }
  return by;
}

std::vector<std::string> FlowChain::called(bool declared) const {
  std::vector<std::string> names;
  const auto look = [&](const LeafFunction& function) {
    if (function.call == nullptr || function.partials) return;
    if (function.declares_derivatives() != declared) return;
    names.push_back(function.jacobian && !declared ? function.name + " (but for its Jacobian)"
                                                   : function.name);
  };
  for (const OfNode& one : for_rates_)
    if (!machine_.plan().node(one.node).boolean) look(one.function);
  for (const LeafFunction& function : rates_) look(function);
  return names;
}

}  // namespace saltus
