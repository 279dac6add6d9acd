#include "taped.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace saltus::python {

namespace {

/// The mode among the results of a tape; empty if it is no mode.
std::optional<int> as_mode(double value) {
  if (value != std::nearbyint(value) || std::abs(value) > 1e9) return std::nullopt;
  return static_cast<int>(value);
}

/// One number after the other: a processor that loads two at once has to wait until both, which
/// were stored one by one just now, are in its cache.
bool all_finite(const VectorRef& numbers) {
  for (const double number : numbers)
    if (!std::isfinite(number)) return false;
  return true;
}

}  // namespace

void Taped::operator()(const At& at, VectorRef out) const {
  slot->tape.evaluate(at, out.data());
  if (!all_finite(out)) called(*leaf, at, out);
}

VectorFunction taped(const PythonLeaf& leaf, const Slot& slot) {
  return Taped{slot, leaf.vector_function(slot->function), &leaf};
}

void TapedMatrix::operator()(const At& at, MatrixRef out) const {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(out.rows(),
                                                                                out.cols());
  rows(at, VectorRef(values.data(), values.size()));
  out = values;
}

MatrixFunction taped_matrix(const PythonLeaf& leaf, const Slot& slot) {
  return TapedMatrix{{slot, leaf.vector_function(slot->function), &leaf}};
}

void TapedEntries::operator()(const At& at, VectorRef out) const {
  slot->jacobian->values.evaluate(at, out.data());
}

void TapedReset::operator()(const At& at, Next& next) const {
  const Trace& trace = *slot;
  Eigen::VectorXd values(trace.tape.size());
  trace.tape.evaluate(at, values.data());
  const auto mode = trace.wrote_mode ? as_mode(values[values.size() - 1]) : 0;
  if (!all_finite(VectorRef(values.data(), values.size())) || !mode) return called(*leaf, at, next);
  const Index nx = trace.wrote_x ? at.x.size() : 0;
  if (trace.wrote_x) next.set_continuous_state(values.head(nx));
  if (trace.wrote_z) next.set_discrete_state(values.segment(nx, at.z.size()));
  if (trace.wrote_mode) next.set_mode(*mode);
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

std::vector<tape::Tape> tapes_of(const VectorFunction& function) {
  if (const auto* tape = function.target<tape::Tape>()) return {*tape};
  if (const auto* entries = function.target<TapedEntries>()) {
    if (entries->slot->jacobian) return {entries->slot->jacobian->values};
  }
  if (const auto* traced = function.target<Taped>()) return {traced->slot->tape};
  return {};
}
std::vector<tape::Tape> tapes_of(const MatrixFunction& function) {
  if (const auto* traced = function.target<TapedMatrix>()) return {traced->rows.slot->tape};
  return {};
}
std::vector<tape::Tape> tapes_of(const ResetMap& function) {
  if (const auto* traced = function.target<TapedReset>()) return {traced->slot->tape};
  return {};
}
std::vector<tape::Tape> tapes_of(const DeliveryMap& function) {
  if (const auto* traced = function.target<TapedDelivery>()) return {traced->reset.slot->tape};
  return {};
}

}  // namespace saltus::python
