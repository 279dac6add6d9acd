#include "ladder_leaf.hpp"

#include <map>
#include <utility>

namespace saltus::python {

namespace {

/// The mode among what a tape gives; empty if it is no mode.
std::optional<int> as_mode(double value) {
  if (value != std::nearbyint(value) || std::abs(value) > 1e9) return std::nullopt;
  return static_cast<int>(value);
}

/// A reset map or update: x+, z+, mode+ one after the other, of those it writes. What is not finite
/// is left to the function itself, which may raise.
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

/// Entry k of a tape.
tape::Tape entry_of(const tape::Tape& tape, std::size_t k) {
  return {tape.graph(), std::span(tape.outputs()).subspan(k, 1)};
}

/// The same matrix with these entries: zero where it has none, without those it has beyond.
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

}  // namespace

LadderLeaf::LadderLeaf(const SurveyedBlock& block, std::span<const Trace> traces)
    : LeafSystem(block.leaf->name()), original_(*block.leaf) {
  declared() = original_.declarations();
  fix_shapes(block);
  for (const Trace& trace : traces) slots_.push_back(std::make_shared<Trace>(trace));
  for (const Slot& slot : slots_) put(slot);
  auto& crossings = declared().zero_crossings;
  for (std::size_t i = 0; i < crossings.size(); ++i)
    narrow_inputs(crossings[i], static_cast<int>(i));
}

/// They are known, so no function need be called again to find them.
void LadderLeaf::fix_shapes(const SurveyedBlock& block) {
  for (std::size_t i = 0; i < block.outputs.size(); ++i)
    declared().outputs[i].shape = block.outputs[i];
}

void LadderLeaf::put(const Slot& slot) {
  const Function& function = original_.function(slot->function);
  const auto crossing = [&]() -> ZeroCrossing& {
    return declared().zero_crossings[static_cast<std::size_t>(function.index)];
  };
  switch (function.role) {
    case Role::ode:
      return put_ode(slot);
    case Role::output:
      return put_output(slot);
    case Role::update:
      return put_time_event(slot);
    case Role::sparse_jacobian:
      declared().continuous.sparse_jacobian = taped(slot);
      return;
    case Role::guard:
      crossing().guard = taped(slot);
      return;
    case Role::reset_map:
      crossing().reset_map = taped_reset(original_, slot, crossing().reset_map);
      return;
    case Role::relation:
      return put_relation(slot);
    case Role::edge_reset: {
      EdgeReset& edge = declared().edge_resets[static_cast<std::size_t>(function.index)];
      edge.reset_map = taped_reset(original_, slot, edge.reset_map);
      edge.inputs = inputs_of(slot);
      return;
    }
    case Role::jacobian:
      declared().continuous.jacobian = [rows = taped(slot), &leaf = original_](const At& at,
                                                                               MatrixRef out) {
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(out.rows(),
                                                                                      out.cols());
        rows(leaf, at, VectorRef(values.data(), values.size()));
        out = values;
      };
  }
}

/// A function that runs the tape. What is not finite is left to the function itself, which may
/// raise, or warn.
VectorFunction LadderLeaf::taped(const Slot& slot) const {
  return [slot, called = original_.vector_function(slot->function), &leaf = original_](
             const At& at, VectorRef out) {
    slot->tape.evaluate(at, out.data());
    if (!out.allFinite()) called(leaf, at, out);
  };
}

void LadderLeaf::put_ode(const Slot& slot) {
  ContinuousState& state = declared().continuous;
  state.ode = taped(slot);
  state.reads = slot->tape.reads();
  state.inputs = inputs_of(slot);
  if (state.jacobian || state.sparse_jacobian || !slot->jacobian) return;
  if (state.sparsity) slot->jacobian = at_places(*slot->jacobian, *state.sparsity);
  state.sparsity = slot->jacobian->entries;
  state.sparse_jacobian = [slot](const At& at, VectorRef out) {
    slot->jacobian->values.evaluate(at, out.data());
  };
}

void LadderLeaf::put_output(const Slot& slot) {
  auto& output =
      declared().outputs[static_cast<std::size_t>(original_.function(slot->function).index)];
  const Reads said = output.reads;
  const Reads found = slot->tape.reads();
  output.inputs = inputs_of(slot);
  output.reads = static_cast<Reads>(static_cast<unsigned>(said) & static_cast<unsigned>(found));
  if (output.boolean && slot->relations && output.reads == found)
    put_relations(slot, output);
  else
    output.calc = taped(slot);
}

void LadderLeaf::put_relation(const Slot& slot) {
  auto& relation =
      declared().relations[static_cast<std::size_t>(original_.function(slot->function).index)];
  relation.guard = taped(slot);
  relation.reads = slot->tape.reads();
  relation.inputs = inputs_of(slot);
}

/// The comparisons become relations, which are located by their smooth guards, and the output is
/// computed from their truths.
void LadderLeaf::put_relations(const Slot& slot, OutputDeclaration& output) {
  const TracedRelations& found = *slot->relations;
  std::vector<RelationIndex> relations;
  const std::size_t count = found.true_at_zero.size();
  for (std::size_t k = 0; k < count; ++k) {
    relations.push_back(
        declare_relation({.name = count == 1 ? text(output.name, " difference")
                                             : text(output.name, " difference ", k),
                          .guard = tape::as_vector_function(entry_of(found.differences, k)),
                          .true_at_zero = found.true_at_zero[k],
                          .reads = output.reads,
                          .inputs = output.inputs}));
  }
  output.reads = Reads::relations;
  output.inputs = std::vector<int>{};
  output.calc = [relations, truth = found.truth](const At& at, VectorRef out) {
    std::vector<double> truths;
    for (const RelationIndex r : relations) truths.push_back(at.relation(r) ? 1.0 : 0.0);
    const VectorView z(truths.data(), static_cast<Index>(truths.size()));
    truth.evaluate(At(at.time, at.x, z, at.p, at.mode, at.u, nullptr), out.data());
  };
}

void LadderLeaf::put_time_event(const Slot& slot) {
  auto& event =
      declared().time_events[static_cast<std::size_t>(original_.function(slot->function).index)];
  event.update = taped_reset(original_, slot, event.update);
  event.inputs = inputs_of(slot);
}

std::optional<Slot> LadderLeaf::slot_of(Role role, int index) const {
  const auto found = std::ranges::find_if(slots_, [&](const Slot& slot) {
    const Function& function = original_.function(slot->function);
    return function.role == role && function.index == index;
  });
  return found == slots_.end() ? std::nullopt : std::optional(*found);
}

/// A guard and its reset map share the list of inputs they read.
void LadderLeaf::narrow_inputs(ZeroCrossing& crossing, int index) {
  const auto guard = slot_of(Role::guard, index), reset = slot_of(Role::reset_map, index);
  if (!guard || (crossing.reset_map && !reset)) return;
  std::vector<int> inputs = inputs_of(*guard);
  if (reset) {
    for (const int k : inputs_of(*reset))
      if (std::ranges::find(inputs, k) == inputs.end()) inputs.push_back(k);
  }
  crossing.inputs = std::move(inputs);
}

std::vector<int> LadderLeaf::inputs_of(const Slot& slot) const {
  std::vector<int> inputs;
  for (int k = 0; k < count_of(original_.declarations().inputs); ++k)
    if (slot->tape.reads_input(k)) inputs.push_back(k);
  return inputs;
}

bool LadderLeaf::fits(const Trace& old, const Trace& now) const {
  if (old.function != now.function) return false;
  if (old.serial == now.serial) return true;
  for (int k = 0; k < count_of(original_.declarations().inputs); ++k)
    if (now.tape.reads_input(k) && !old.tape.reads_input(k)) return false;
  const Role role = original_.function(now.function).role;
  if (role != Role::output && role != Role::relation) return true;
  const bool slower = (old.tape.reads() | now.tape.reads()) == old.tape.reads();
  return slower && !old.relations && !now.relations;
}

bool LadderLeaf::replace(std::span<const Trace> traces) {
  const auto fit = [this](const Slot& slot, const Trace& now) { return fits(*slot, now); };
  if (!std::ranges::equal(slots_, traces, fit)) return false;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    Trace now = traces[i];
    if (now.jacobian && slots_[i]->jacobian)
      now.jacobian = at_places(*now.jacobian, slots_[i]->jacobian->entries);
    *slots_[i] = std::move(now);
  }
  return true;
}

}  // namespace saltus::python
