// ChainRule: the walk along the wires, and the derivatives of one function.
#include "saltus/simulation/detail/chain_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/plan/detail/needs.hpp"
#include "saltus/simulation/detail/kinks.hpp"

namespace saltus {

namespace {

std::vector<int> roots_of(const Plan& plan) {
  std::vector<int> roots;
  for (const int leaf : plan.odes) detail::add_derivative_roots(plan.leaf(leaf), roots);
  for (const Tap& tap : plan.taps) roots.push_back(tap.node);
  return roots;
}

}  // namespace

ChainRule::ChainRule(Machine& machine, LinearColumns columns)
    : machine_(machine),
      plan_(machine.plan()),
      columns_(std::move(columns)),
      probe_(machine),
      of_called_(machine, probe_),
      variables_(machine),
      wanted_(plan_.nodes.size()),
      functions_(plan_.nodes.size()) {
  const auto never = [](const Node&) { return false; };
  std::vector<int> roots = roots_of(plan_);
  detail::spread(plan_, roots, wanted_, never);
  for (const GuardGroup& group : plan_.guards) {
    if (group.is_crossing() && plan_.crossing_of(group).has_effect())
      detail::append(roots, nodes_of_guard(plan_, group));
  }
  for (const EdgeWatch& edge : plan_.edges) detail::append(roots, edge.relations);
  List<char> reached(plan_.nodes.size());
  detail::spread(plan_, roots, reached, never);
  for (const int i : plan_.order) {
    if (reached[i] == 0 || plan_.node(i).view) continue;
    order_.push_back(i);
    functions_[i] = function_of_node(plan_, i);
    if (wanted_[i] != 0 && (plan_.node(i).relation || plan_.node(i).opaque())) truths_.push_back(i);
  }
  for (const int leaf : plan_.odes) odes_.push_back(function_of_rates(plan_, leaf));
}

/// The columns by which a node has a derivative. A truth has none. A held output keeps its value where
/// the state moves, and follows the parameters of its block, as the level of a Step does.
ChainRule::Follows ChainRule::follows(const Node& node) const {
  if (node.relation || node.boolean || detail::is_fixed(plan_, node)) return Follows::nothing;
  return samples(plan_.output_of(node).reads) ? Follows::parameters : Follows::all;
}

void ChainRule::at(double t, const Forced& forced) {
  t_ = t;
  obstacle_.clear(), called_.clear();
  y_.setZero(plan_.ny, columns_.size);
  for (Index i = 0; i < plan_.ny; ++i)
    if (columns_.of_signal[i] >= 0) y_(i, columns_.of_signal[i]) = 1.0;
  probe_.begin(), probe_.note(machine_.x.data(), 0.0);
  for (const int i : order_) evaluate(i, forced);
  rates_.setZero(plan_.nx), rates_by_.setZero(plan_.nx, columns_.size);
  for (const LeafFunction& ode : odes_) {
    const Index first = plan_.leaf(ode.leaf).x;
    call(ode, rates_.data() + first);
    rates_by_.middleRows(first, ode.size) = derivative(ode);
  }
}

/// The value of a node, as the run would have it, and its derivatives. What is held keeps its value.
void ChainRule::evaluate(int i, const Forced& forced) {
  const Node& node = plan_.node(i);
  double* value = machine_.signal(i);
  const bool held = node.located || (!node.relation && samples(plan_.output_of(node).reads));
  if (!held) {
    call(*functions_[i], value);
    for (Index k = 0; k < node.place.size && node.relation; ++k)
      value[k] = value[k] > 0.0 || (plan_.relation_of(node).true_at_zero && value[k] == 0.0);
  }
  if (forced.node == i) value[forced.entry] = value[forced.entry] == 0.0;
  follows_ = follows(node);
  if (follows_ != Follows::nothing)
    y_.middleRows(node.place.offset, node.place.size) = derivative(*functions_[i]);
  follows_ = Follows::all;
}

void ChainRule::call(const LeafFunction& function, double* out) {
  VectorRef values(out, function.size);
  if (function.call == nullptr) return values.setZero(), void();
  const At at = machine_.at(function.leaf, t_, machine_.x.data());
  (*function.call)(*plan_.leaf(function.leaf).system, at, values);
}

Eigen::VectorXd ChainRule::value(int node) const {
  const Place& place = plan_.node(node).place;
  return VectorView(machine_.value(place), place.size);
}

Eigen::MatrixXd ChainRule::by(int node) const {
  const Place& place = plan_.node(node).place;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(place.size, columns_.size);
  Eigen::RowVectorXd row(columns_.size);
  for (Index i = 0; i < place.size && place.space != Space::z; ++i) {
    row.setZero();
    add({place.space, place.offset + i}, 1.0, row);
    rows.row(i) = row;
  }
  return rows;
}

ChainRule::Level ChainRule::level(const LeafFunction& function) {
  Level found{Eigen::VectorXd(function.size), {}};
  call(function, found.value.data());
  const std::string obstacle = std::exchange(obstacle_, {});
  const auto called = called_;
  found.by = derivative(function);
  obstacle_ = obstacle, called_ = called;  // a guard decides no derivative
  return found;
}

std::vector<std::string> ChainRule::called() const { return called_; }

/// Whether a value moves with one of the columns.
bool ChainRule::moves(const ReadValue& read) const {
  if (read.space == Space::p) return !columns_.parameters.of_entry(read.index).empty();
  if (read.space == Space::z || follows_ == Follows::parameters) return false;
  if (read.space == Space::x) return true;
  return !y_.row(read.index).isZero(0.0);
}

void ChainRule::add(const ReadValue& read, double value, Eigen::Ref<Eigen::RowVectorXd> row) const {
  if (read.space == Space::x) row[read.index] += value;
  if (read.space == Space::y) row += value * y_.row(read.index);
  if (read.space != Space::p) return;
  for (const auto& column : columns_.parameters.of_entry(read.index))
    row[column.number] += value * column.by;
}

Eigen::MatrixXd ChainRule::derivative(const LeafFunction& function) {
  if (function.call == nullptr) return Eigen::MatrixXd::Zero(function.size, columns_.size);
  Eigen::MatrixXd by = function.partials ? exact(function) : differences(function);
  if (!by.allFinite() && obstacle_.empty())
    obstacle_ = text(function.name, " has a derivative that is not finite");
  return by;
}

Eigen::MatrixXd ChainRule::exact(const LeafFunction& function) {
  const LeafPartials& partials = *function.partials;
  values_.resize(partials.tape.size());
  variables_.at(t_, machine_.x.data(),
                [&](const At& at) { partials.tape.evaluate(at, values_.data()); });
  const Eigen::VectorXd values = values_;
  const double* switches =
      values.data() + function.size + static_cast<Index>(partials.entries.size());
  if (has_switch_at_limit(switches, partials.switches) && has_kink(function) && obstacle_.empty())
    obstacle_ = text(function.name, " has a kink or a jump");
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(function.size, columns_.size);
  Eigen::RowVectorXd row(columns_.size);
  for (std::size_t e = 0; e < partials.entries.size(); ++e) {
    const auto& [i, number] = partials.entries[e];
    const ReadValue& read = function.reads[number];
    if (!moves(read)) continue;
    row.setZero();
    add(read, values[function.size + static_cast<Index>(e)], row);
    by.row(i) += row;
  }
  return by;
}

Eigen::MatrixXd ChainRule::differences(const LeafFunction& function) {
  const Eigen::MatrixXd each =
      of_called_.of(function, t_, [this](const ReadValue& read) { return moves(read); });
  if (!of_called_.obstacle().empty() && obstacle_.empty())
    obstacle_ = text(function.name, ": ", of_called_.obstacle());
  if (of_called_.differenced()) called_.push_back(function.name);
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(function.size, columns_.size);
  Eigen::RowVectorXd row(columns_.size);
  for (Index k = 0; k < each.cols(); ++k) {
    for (Index i = 0; i < function.size; ++i) {
      if (each(i, k) == 0.0) continue;
      row.setZero();
      add(nth(function.reads, k), each(i, k), row);
      by.row(i) += row;
    }
  }
  return by;
}

double ChainRule::value_of(const ReadValue& read) const {
  return *machine_.value({read.space, read.index, 1});
}

}  // namespace saltus
