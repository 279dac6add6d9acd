// The derivatives of held signals.
#include "saltus/simulation/detail/held_tangents.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "saltus/simulation/detail/kinks.hpp"
#include "saltus/tape/switches.hpp"

namespace saltus {

namespace {

void clear_truths(const Plan& plan, Eigen::MatrixXd& y) {
  for (const Node& node : plan.nodes) {
    if ((node.relation || node.boolean) && node.place.space == Space::y && !node.view)
      y.middleRows(node.place.offset, node.place.size).setZero();
  }
}

}  // namespace

void HeldTangents::begin(const Context& start, TangentColumns& columns) {
  functions_ = -1, obstacle_.clear();
  for (Index k = 0; k < columns.size(); ++k) {
    const std::span<const ParameterMove> moves = columns.moves(k);
    if (moves.empty()) continue;
    const auto read = [&](Machine& moved, double shift, double* out) {
      ContextValues values = start.values();
      for (const ParameterMove& move : moves) values.parameters[move.entry] += shift * move.by;
      values.continuation = nullptr, values.pending = nullptr;
      moved.load(start.with_values(values));
      std::copy_n(moved.y.data(), moved.y.size(), out);
    };
    probe_->derivative(machine_->x.data(), {.p = moves}, machine_->y.size(), read,
                       columns.y.col(k).data());
  }
  clear_truths(machine_->plan(), columns.y);
}

void HeldTangents::make() {
  functions_ = flow_->renew();
  SignalGraph signals = signal_graph(machine_->plan());
  const std::vector<tape::Node> switches = tape::switches_of(signals.graph, signals.values);
  exact_.emplace(Exact{flow_->partials(signals.graph, signals.values, true),
                       std::move(signals.places),
                       {},
                       signals.whole});
  if (!switches.empty()) exact_->switches.emplace(signals.graph, switches);
}

/// What no instant computes keeps its derivatives.
void HeldTangents::follow(double t, TangentColumns& columns) {
  obstacle_.clear();
  if (functions_ != flow_->renew()) make();
  const bool kink = has_kink_at(t);
  Eigen::MatrixXd y = columns.y;
  if (kink || !exact_->whole) differ(t, columns, y);
  if (!kink) add_exact(t, columns, y);
  columns.y = std::move(y);
  clear_truths(machine_->plan(), columns.y);
}

bool HeldTangents::has_kink_at(double t) {
  if (!exact_->switches) return false;
  Eigen::VectorXd numbers(exact_->switches->size());
  FlowVariables(*machine_).at(
      t, machine_->x.data(), [&](const At& at) { exact_->switches->evaluate(at, numbers.data()); });
  return has_switch_at_limit(numbers.data(), numbers.size() / tape::numbers_of_switch);
}

void HeldTangents::differ(double t, TangentColumns& columns, Eigen::MatrixXd& y) {
  for (Index k = 0; k < columns.size(); ++k) {
    const auto read = [&](Machine& moved, double shift, double* out) {
      moved.evaluate_instant(t + shift * columns.t[k]);
      std::copy_n(moved.y.data(), moved.y.size(), out);
    };
    probe_->derivative(machine_->x.data(), columns.column(k), y.rows(), read, y.col(k).data());
    if (obstacle_.empty()) obstacle_ = probe_->obstacle();
  }
}

/// The rows of signals that are called, and of those that no instant computes, are known.
void HeldTangents::add_exact(double t, const TangentColumns& columns, Eigen::MatrixXd& y) {
  using Variable = TangentFlow::Variable;
  flow_->evaluate(exact_->partials, t, machine_->x.data());
  for (const Index place : exact_->places) y.row(place).setZero();
  for (std::size_t e = 0; e < exact_->partials.entries.size(); ++e) {
    const auto [row, kind, index] = exact_->partials.entries[e];
    const double value = exact_->partials.values[static_cast<Index>(e)];
    auto to = y.row(nth(exact_->places, row));
    if (kind == Variable::x) to += value * columns.x.row(index);
    if (kind == Variable::z) to += value * columns.z.row(index);
    if (kind == Variable::y) to += value * y.row(index);
    if (kind == Variable::t) to += value * columns.t;
    if (kind != Variable::p) continue;
    for (const auto& column : columns.by_entry(index)) to[column.number] += value * column.by;
  }
}

}  // namespace saltus
