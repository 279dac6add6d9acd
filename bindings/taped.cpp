#include "taped.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace saltus::python {

namespace {

/// The mode among what a tape gives; empty if it is no mode.
std::optional<int> as_mode(double value) {
  if (value != std::nearbyint(value) || std::abs(value) > 1e9) return std::nullopt;
  return static_cast<int>(value);
}

}  // namespace

VectorFunction taped(const PythonLeaf& leaf, const Slot& slot) {
  return [slot, called = leaf.vector_function(slot->function), &leaf](const At& at, VectorRef out) {
    slot->tape.evaluate(at, out.data());
    if (!out.allFinite()) called(leaf, at, out);
  };
}

MatrixFunction taped_matrix(const PythonLeaf& leaf, const Slot& slot) {
  return [rows = taped(leaf, slot), &leaf](const At& at, MatrixRef out) {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(out.rows(),
                                                                                  out.cols());
    rows(leaf, at, VectorRef(values.data(), values.size()));
    out = values;
  };
}

ResetMap taped_reset(const PythonLeaf& leaf, Slot slot, ResetMap called) {
  return [&leaf, slot = std::move(slot), called = std::move(called)](const At& at, Next& next) {
    const Trace& trace = *slot;
    Eigen::VectorXd values(trace.tape.size());
    trace.tape.evaluate(at, values.data());
    const auto mode = trace.wrote_mode ? as_mode(values[values.size() - 1]) : 0;
    if (!values.allFinite() || !mode) return called(leaf, at, next);
    const Index nx = trace.wrote_x ? at.x.size() : 0;
    if (trace.wrote_x) next.set_continuous_state(values.head(nx));
    if (trace.wrote_z) next.set_discrete_state(values.segment(nx, at.z.size()));
    if (trace.wrote_mode) next.set_mode(*mode);
  };
}

tape::Jacobian at_places(const tape::Jacobian& jacobian, const std::vector<MatrixEntry>& places) {
  std::map<std::pair<Index, Index>, tape::Node> known;
  for (std::size_t i = 0; i < jacobian.entries.size(); ++i) {
    known.emplace(std::pair(jacobian.entries[i].row, jacobian.entries[i].column),
                  jacobian.values.outputs()[i]);
  }
  tape::Graph graph = jacobian.values.graph();
  const tape::Node zero = graph.constant(0.0);
  std::vector<tape::Node> values;
  for (const auto& [row, column] : places) {
    const auto found = known.find({row, column});
    values.push_back(found == known.end() ? zero : found->second);
  }
  return {places, tape::Tape(graph, values)};
}

}  // namespace saltus::python
