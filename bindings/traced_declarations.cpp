#include "traced_declarations.hpp"

#include <optional>
#include <utility>

#include "saltus/model/detail/names.hpp"
#include "taped.hpp"
#include "traced_formula.hpp"

namespace saltus::python {

namespace {

/// Entry k of a tape.
tape::Tape entry_of(const tape::Tape& tape, std::size_t k) {
  return {tape.graph(), std::span(tape.outputs()).subspan(k, 1)};
}

/// The entries of x+ that are not the same entry of x: the first n values of the tape are x+.
std::vector<int> changed_states(const tape::Tape& tape, Index n) {
  std::vector<int> changed;
  for (int i = 0; i < n; ++i) {
    const tape::Expression& value = tape.graph()[tape.outputs()[i]];
    if (value.op != tape::Op::continuous_state || value.index != i) changed.push_back(i);
  }
  return changed;
}

/// The inputs that a tape reads.
std::vector<int> inputs_of(const PythonLeaf& leaf, const Slot& slot) {
  std::vector<int> inputs;
  for (int k = 0; k < count_of(leaf.declarations().inputs); ++k)
    if (slot->tape.reads_input(k)) inputs.push_back(k);
  return inputs;
}

/// Changes a copy of the declarations of a block, one trace after the other.
class DeclarationWriter {
 public:
  DeclarationWriter(const PythonLeaf& leaf, const std::vector<Slot>& slots)
      : original_(leaf), slots_(slots), declared_(leaf.declarations()) {}

  Declarations write(const std::vector<Shape>& outputs);

 private:
  void put(const Slot& slot);
  void put_ode(const Slot& slot);
  void put_output(const Slot& slot);
  void put_guard(const Slot& slot, ZeroCrossing& crossing);
  void put_relation(const Slot& slot);
  void put_relations(const Slot& slot, OutputDeclaration& output);
  RelationIndex add_relation(Relation relation);
  void put_time_event(const Slot& slot);
  void narrow_inputs(ZeroCrossing& crossing, int index);
  void note_touches(ZeroCrossing& crossing, int index);
  std::optional<Slot> slot_of(Role role, int index) const;
  VectorFunction taped(const Slot& slot) const { return python::taped(original_, slot); }
  /// The formula, which is joined with others where the author of the block allows it.
  Formula formula(const Slot& slot) const {
    return formula_of(slot, original_.function(slot->function).formula);
  }

  const PythonLeaf& original_;
  const std::vector<Slot>& slots_;
  Declarations declared_;
};

Declarations DeclarationWriter::write(const std::vector<Shape>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) declared_.outputs[i].shape = outputs[i];
  for (const Slot& slot : slots_) put(slot);
  auto& crossings = declared_.zero_crossings;
  for (std::size_t i = 0; i < crossings.size(); ++i)
    narrow_inputs(crossings[i], static_cast<int>(i)),
        note_touches(crossings[i], static_cast<int>(i));
  return std::move(declared_);
}

void DeclarationWriter::put(const Slot& slot) {
  const Function& function = original_.function(slot->function);
  const auto crossing = [&]() -> ZeroCrossing& { return declared_.zero_crossings[function.index]; };
  switch (function.role) {
    case Role::ode:
      return put_ode(slot);
    case Role::output:
      return put_output(slot);
    case Role::update:
      return put_time_event(slot);
    case Role::sparse_jacobian:
      declared_.continuous.sparse_jacobian = taped(slot);
      return;
    case Role::guard:
      return put_guard(slot, crossing());
    case Role::reset_map:
      crossing().reset_map = TapedReset{slot, crossing().reset_map, &original_};
      return;
    case Role::delay:
      crossing().delay = NumberOf(taped(slot));
      return;
    case Role::priority:
      crossing().priority = NumberOf(taped(slot));
      return;
    case Role::relation:
      return put_relation(slot);
    case Role::jacobian:
      declared_.continuous.jacobian = taped_matrix(original_, slot);
      return;
    case Role::edge_reset: {
      EdgeReset& edge = declared_.edge_resets[function.index];
      edge.reset_map = TapedReset{slot, edge.reset_map, &original_};
      edge.inputs = inputs_of(original_, slot);
      return;
    }
    case Role::derivatives:  // it is called
      return;
    case Role::event_input: {
      EventInputDeclaration& input = declared_.event_inputs[function.index];
      // The function itself as a reset map: the tape calls it where its own result is not finite.
      input.reset_map = TapedDelivery{{slot, original_.reset_map(slot->function), &original_}};
      input.inputs = inputs_of(original_, slot);
      return;
    }
  }
}

void DeclarationWriter::put_ode(const Slot& slot) {
  ContinuousState& state = declared_.continuous;
  state.ode = taped(slot);
  state.formula = formula(slot);
  state.reads = slot->tape.reads();
  state.inputs = inputs_of(original_, slot);
  if (state.jacobian || state.sparse_jacobian || !slot->jacobian) return;
  if (state.sparsity) slot->jacobian = at_places(*slot->jacobian, *state.sparsity);
  state.sparsity = slot->jacobian->entries;
  state.sparse_jacobian = TapedEntries{slot};
}

/// A truth becomes the difference of its sides. The truth changes where the difference crosses zero;
/// the difference itself changes all the time.
void DeclarationWriter::put_guard(const Slot& slot, ZeroCrossing& crossing) {
  crossing.guard = taped(slot);
  crossing.formula = formula(slot);
  if (slot->relations && crossing.direction == Direction::edge_detection)
    crossing.direction = Direction::crosses_zero;
}

void DeclarationWriter::put_output(const Slot& slot) {
  auto& output = declared_.outputs[original_.function(slot->function).index];
  const Reads said = output.reads;
  const Reads found = slot->tape.reads();
  output.inputs = inputs_of(original_, slot);
  output.reads = static_cast<Reads>(static_cast<unsigned>(said) & static_cast<unsigned>(found));
  if (output.boolean && slot->relations && output.reads == found)
    put_relations(slot, output);
  else
    output.calc = taped(slot), output.formula = formula(slot);
}

/// A relation that Python declares: its guard as a tape.
void DeclarationWriter::put_relation(const Slot& slot) {
  auto& relation = declared_.relations[original_.function(slot->function).index];
  relation.guard = taped(slot);
  relation.formula = formula(slot);
  relation.reads = slot->tape.reads();
  relation.inputs = inputs_of(original_, slot);
}

/// The comparisons become relations, which are located by their smooth guards, and the output is
/// computed from their truths.
void DeclarationWriter::put_relations(const Slot& slot, OutputDeclaration& output) {
  const TracedRelations& found = *slot->relations;
  std::vector<RelationIndex> relations;
  const std::size_t count = found.true_at_zero.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto difference = std::make_shared<Trace>(*slot);
    difference->tape = entry_of(found.differences, k);
    relations.push_back(add_relation({.name = count == 1 ? text(output.name, " difference")
                                                         : text(output.name, " difference ", k),
                                      .guard = tape::as_vector_function(difference->tape),
                                      .true_at_zero = found.true_at_zero[k],
                                      .reads = output.reads,
                                      .inputs = output.inputs,
                                      .formula = formula_of(difference, false)}));
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

/// Declares a relation, as LeafSystem::declare_relation does.
RelationIndex DeclarationWriter::add_relation(Relation relation) {
  detail::name_it(relation.name, declared_.relations, "relation_", original_.name());
  declared_.relations.push_back(std::move(relation));
  return {count_of(declared_.relations) - 1};
}

void DeclarationWriter::put_time_event(const Slot& slot) {
  auto& event = declared_.time_events[original_.function(slot->function).index];
  event.update = TapedReset{slot, event.update, &original_};
  event.inputs = inputs_of(original_, slot);
}

std::optional<Slot> DeclarationWriter::slot_of(Role role, int index) const {
  const auto found = std::ranges::find_if(slots_, [&](const Slot& slot) {
    const Function& function = original_.function(slot->function);
    return function.role == role && function.index == index;
  });
  return found == slots_.end() ? std::nullopt : std::optional(*found);
}

/// A guard and its reset map share the list of inputs they read.
void DeclarationWriter::narrow_inputs(ZeroCrossing& crossing, int index) {
  const auto guard = slot_of(Role::guard, index), reset = slot_of(Role::reset_map, index);
  if (!guard || (crossing.reset_map && !reset)) return;
  std::vector<int> inputs = inputs_of(original_, *guard);
  if (reset) {
    for (const int k : inputs_of(original_, *reset))
      if (std::ranges::find(inputs, k) == inputs.end()) inputs.push_back(k);
  }
  crossing.inputs = std::move(inputs);
}

/// Notes which states a guard and its reset map touch. A reset map that depends on the index of the
/// guard may write other entries for each: then nothing is known of it.
void DeclarationWriter::note_touches(ZeroCrossing& crossing, int index) {
  const auto guard = slot_of(Role::guard, index), reset = slot_of(Role::reset_map, index);
  if (!guard || (crossing.reset_map && !reset)) return;
  Touches touches{.reads = (*guard)->tape.states_read(),
                  .writes_discrete_state = reset && (*reset)->wrote_z,
                  .writes_mode = reset && (*reset)->wrote_mode};
  if (reset && (*reset)->wrote_x) {
    if ((*reset)->tape.reads_entry()) return;
    touches.writes = changed_states((*reset)->tape, declared_.continuous.initial.size());
  }
  crossing.touches = std::move(touches);
}

}  // namespace

std::shared_ptr<const Declarations> traced_declarations(const PythonLeaf& leaf,
                                                        const std::vector<Shape>& outputs,
                                                        const std::vector<Slot>& slots,
                                                        const SharedOutside& shared) {
  Declarations declared = DeclarationWriter(leaf, slots).write(outputs);
  declare_shared(leaf, shared, declared);
  return std::make_shared<const Declarations>(std::move(declared));
}

}  // namespace saltus::python
