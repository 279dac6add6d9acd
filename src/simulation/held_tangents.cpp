// The derivatives of held signals.
#include "saltus/simulation/detail/held_tangents.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace saltus {

namespace {

void clear_truths(const Plan& plan, Eigen::MatrixXd& y) {
  for (const Node& node : plan.nodes) {
    if ((node.relation || node.boolean) && node.place.space == Space::y && !node.view)
      y.middleRows(node.place.offset, node.place.size).setZero();
  }
}

}  // namespace

void begin_signals(TangentProbe& probe, const Machine& machine, const Context& start,
                   TangentColumns& columns) {
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
    probe.derivative(machine.x.data(), {.p = moves}, machine.y.size(), read,
                     columns.y.col(k).data());
  }
  clear_truths(machine.plan(), columns.y);
}

void follow_signals(TangentProbe& probe, const Machine& machine, double t,
                    TangentColumns& columns) {
  Eigen::MatrixXd y(machine.y.size(), columns.size());
  for (Index k = 0; k < columns.size(); ++k) {
    const auto read = [&](Machine& moved, double shift, double* out) {
      moved.evaluate_instant(t + shift * columns.t[k]);
      std::copy_n(moved.y.data(), moved.y.size(), out);
    };
    probe.derivative(machine.x.data(), columns.column(k), y.rows(), read, y.col(k).data());
  }
  columns.y = std::move(y);
  clear_truths(machine.plan(), columns.y);
}

}  // namespace saltus
