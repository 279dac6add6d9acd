// TangentFlow: exact derivatives from the plan's graph, or differences.
#include "saltus/simulation/detail/tangent_flow.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/kinks.hpp"
#include "saltus/tape/jacobian.hpp"
#include "saltus/tape/switches.hpp"

namespace saltus {

namespace {

/// Whether some of these expressions read the time, also where it has no effect nearly everywhere, as
/// in floor(t): the flow may jump there.
bool read_time(const tape::Graph& graph, const std::vector<tape::Node>& nodes) {
  std::vector<char> seen(static_cast<std::size_t>(graph.size()), 0);
  std::vector<tape::Node> open = nodes;
  while (!open.empty()) {
    const tape::Node node = open.back();
    open.pop_back();
    if (std::exchange(nth(seen, node.id), char{1})) continue;
    const tape::Expression& of = graph[node];
    if (of.op == tape::Op::time) return true;
    open.insert(open.end(), of.operands.begin(), of.operands.begin() + operand_count(of.op));
  }
  return false;
}

/// [of a step] How far a state is followed to see whether it stays at a switch: far above rounding.
constexpr double part_of_step = 1e-3;

}  // namespace

void fix_time(TangentProbe& probe, double t, const double* x, TangentColumns& at) {
  if (at.t.isZero(0.0)) return;
  at.x -= probe.flow(t, x) * at.t;
  at.t.setZero();
}

TangentFlow::TangentFlow(const Machine& machine, TangentProbe& probe)
    : machine_(&machine), probe_(&probe), variables_(machine) {}

void TangentFlow::begin(const ParameterMoves& moves) {
  std::vector<Index> moved;
  for (Index i = 0; i < machine_->plan().np; ++i)
    if (!moves.of_entry(i).empty()) moved.push_back(i);
  const bool same = made_ && functions_ == machine_->functions() && moved == moved_;
  moved_ = std::move(moved);
  if (!same) make();
}

/// Makes the tapes of the present functions.
void TangentFlow::make() {
  functions_ = machine_->functions(), made_ = true;
  const Plan& plan = machine_->plan();
  FlowGraph flow = flow_graph(plan);
  rates_.reset(), guards_.reset(), chain_.reset(), switches_.reset(), switched_.reset();
  guard_switches_.clear();
  row_of_slot_.assign(static_cast<std::size_t>(plan.guard_slots), -1);
  if (!flow.obstacle.empty()) return chain(), void();
  std::vector<tape::Node> rows(flow.rates.begin(), flow.rates.end());
  reads_time_ = read_time(flow.graph, rows);
  rates_ = partials(flow.graph, rows, false);
  const std::vector<tape::Node> switches = tape::switches_of(flow.graph, rows);
  if (!switches.empty()) switches_.emplace(flow.graph, switches);
  rows.clear();
  for (std::size_t slot = 0; slot < flow.guards.size(); ++slot) {
    if (!flow.guards[slot]) continue;
    row_of_slot_[slot] = static_cast<Index>(rows.size());
    rows.push_back(*flow.guards[slot]);
  }
  guards_ = partials(flow.graph, rows, true);
}

TangentFlow::Partials TangentFlow::partials(tape::Graph& graph, const std::vector<tape::Node>& rows,
                                            bool by_time) const {
  const Plan& plan = machine_->plan();
  std::vector<tape::Node> variables;
  std::vector<std::pair<Variable, Index>> names;
  const auto add_one = [&](Variable kind, Index i, tape::Node node) {
    variables.push_back(node), names.emplace_back(kind, i);
  };
  const auto add = [&](Variable kind, Index size, const auto& node_of) {
    for (Index i = 0; i < size; ++i) add_one(kind, i, node_of(i));
  };
  add(Variable::x, plan.nx, [&](Index i) { return graph.continuous_state(i); });
  add(Variable::z, plan.nz, [&](Index i) { return graph.input(0, i); });
  add(Variable::y, plan.ny, [&](Index i) { return graph.discrete_state(i); });
  for (const Index i : moved_) add_one(Variable::p, i, graph.parameter(i));
  if (by_time) add_one(Variable::t, 0, graph.time());
  std::vector<Entry> entries;
  std::vector<tape::Node> values;
  for (const tape::Partial& one : tape::differentiate(graph, rows, variables)) {
    const auto [kind, index] = nth(names, one.column);
    entries.push_back({one.row, kind, index});
    values.push_back(one.value);
  }
  return {std::move(entries), tape::Tape(graph, values),
          Eigen::VectorXd(static_cast<Index>(values.size()))};
}

void TangentFlow::evaluate(Partials& of, double t, const double* x) {
  variables_.at(t, x, [&](const At& at) { of.tape.evaluate(at, of.values.data()); });
}

void TangentFlow::at(double t, const double* x, const TangentColumns& columns,
                     Eigen::MatrixXd& jacobian, Eigen::MatrixXd& by) {
  if (functions_ != machine_->functions()) make();
  const Index n = machine_->plan().nx;
  jacobian.setZero(n, n), by.setZero(n, columns.size());
  exact() ? exact_at(t, x, columns, jacobian, by) : chain().at(t, x, columns, jacobian, by);
}

void TangentFlow::exact_at(double t, const double* x, const TangentColumns& columns,
                           Eigen::MatrixXd& jacobian, Eigen::MatrixXd& by) {
  evaluate(*rates_, t, x);
  for (std::size_t e = 0; e < rates_->entries.size(); ++e) {
    const auto [row, kind, index] = rates_->entries[e];
    const double value = rates_->values[static_cast<Index>(e)];
    if (machine_->resting().rests(row)) continue;
    if (kind == Variable::x) jacobian(row, index) += value;
    if (kind == Variable::z) by.row(row) += value * columns.z.row(index);
    if (kind == Variable::y) by.row(row) += value * columns.y.row(index);
    if (kind != Variable::p) continue;
    for (const auto& column : columns.by_entry(index)) by(row, column.number) += value * column.by;
  }
}

bool TangentFlow::rests_at_switch(double t, const double* x, const Eigen::VectorXd& flow) {
  if (!switches_) return false;
  const Index count = switches_->size();
  Eigen::VectorXd here(count), there(count);
  variables_.at(t, x, [&](const At& at) { switches_->evaluate(at, here.data()); });
  if (!has_switch_at_limit(here.data(), count / tape::numbers_of_switch)) return false;
  const double step = probe_->sizes().step;
  const double ahead = step > 0.0 ? part_of_step * step : part_of_step * std::max(1.0, std::abs(t));
  const Eigen::VectorXd later = VectorView(x, flow.size()) + ahead * flow;
  variables_.at(t + ahead, later.data(),
                [&](const At& at) { switches_->evaluate(at, there.data()); });
  for (Index k = 0; k < count; k += tape::numbers_of_switch)
    if (has_switch_at_limit(&here[k], 1) && has_switch_at_limit(&there[k], 1)) return true;
  return false;
}

bool TangentFlow::bends(double t, const double* x, const TangentDirection& along) {
  const auto values_at = [&](double shift) -> Eigen::ArrayXd {
    Machine& probe = probe_->at(x, along, shift);
    Eigen::VectorXd values(rates_->tape.size());
    FlowVariables(probe).at(t, probe.x.data(),
                            [&](const At& at) { rates_->tape.evaluate(at, values.data()); });
    return values.array();
  };
  return has_kink(values_at, probe_->reach(x, along));
}

FlowChain& TangentFlow::chain() { return chain_ ? *chain_ : chain_.emplace(*machine_, *probe_); }

GuardTangent TangentFlow::guard(double t, const double* x, Index slot,
                                const TangentColumns& columns) {
  if (functions_ != machine_->functions()) make();
  const Index row = nth(row_of_slot_, slot);
  return row >= 0 ? exact_row(*guards_, t, x, row, columns) : called_guard(t, x, slot, columns);
}

/// The derivative by the time, where it is not declared, is a difference of the guard and of all that
/// it reads.
GuardTangent TangentFlow::called_guard(double t, const double* x, Index slot,
                                       const TangentColumns& columns) {
  GuardTangent found{Eigen::VectorXd::Zero(machine_->plan().nx), 0.0, {}};
  chain().guard(t, x, slot, columns, found.by_state, found.columns);
  if (const auto declared = chain().guard_by_time(t, slot))
    found.by_time = *declared;
  else
    difference_by_time(t, x, slot, found.by_time);
  found.columns += found.by_time * columns.t;
  return found;
}

void TangentFlow::difference_by_time(double t, const double* x, Index slot, double& by_time) {
  Eigen::VectorXd g(machine_->plan().look_slots);
  const auto read = [&](Machine& probe, double shift, double* out) {
    probe.guards_at(t + shift, probe.x.data(), g.data());
    *out = g[slot];
  };
  probe_->derivative(x, {.t = 1.0}, 1, read, &by_time);
}

GuardTangent TangentFlow::exact_row(Partials& all, double t, const double* x, Index row,
                                    const TangentColumns& columns) {
  GuardTangent found{Eigen::VectorXd::Zero(machine_->plan().nx), 0.0,
                     Eigen::RowVectorXd::Zero(columns.size())};
  evaluate(all, t, x);
  for (std::size_t e = 0; e < all.entries.size(); ++e) {
    const auto [of, kind, index] = all.entries[e];
    const double value = all.values[static_cast<Index>(e)];
    if (of != row) continue;
    if (kind == Variable::x) {
      found.by_state[index] += value;
      found.columns += value * columns.x.row(index);
    }
    if (kind == Variable::z) found.columns += value * columns.z.row(index);
    if (kind == Variable::y) found.columns += value * columns.y.row(index);
    if (kind == Variable::t) {
      found.by_time += value;
      found.columns += value * columns.t;
    }
    if (kind != Variable::p) continue;
    for (const auto& column : columns.by_entry(index))
      found.columns[column.number] += value * column.by;
  }
  return found;
}

bool TangentFlow::autonomous() const { return exact() && !reads_time_; }

std::string TangentFlow::describe() const {
  if (flow_graph(machine_->plan()).obstacle.empty()) return "by exact derivatives of the flow";
  const FlowChain chain(*machine_, *probe_);
  const auto listed = [](std::string_view before, const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& one : names) all += (all.empty() ? before : ", "), all += one;
    return all;
  };
  return "by exact derivatives of the flow" +
         listed(", declared derivatives of ", chain.called(true)) +
         listed(", central differences of ", chain.called(false));
}

}  // namespace saltus
