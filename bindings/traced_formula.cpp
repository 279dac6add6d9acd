#include "traced_formula.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace saltus::python {

namespace {

using tape::Op;
using tape::Symbol;

/// A variable or a constant of a tape, as the formula of a block reads it.
Symbol variable(const EntryAt<Symbol>& at, const tape::Expression& e) {
  switch (e.op) {
    case Op::constant:
      return e.value;
    case Op::time:
      return at.time();
    case Op::continuous_state:
      return at.x(e.index);
    case Op::discrete_state:
      return at.z(e.index);
    case Op::mode:
      return at.mode();
    case Op::parameter:
      return at.p(ParameterIndex{e.index, 1}, 0);
    default:
      return at.u(e.port, e.index);
  }
}

Symbol applied(const tape::Expression& e, const std::vector<Symbol>& values) {
  const auto operand = [&](std::size_t k) { return nth(values, e.operands[k].id); };
  switch (tape::operand_count(e.op)) {
    case 1:
      return Symbol::apply(e.op, {operand(0)});
    case 2:
      return Symbol::apply(e.op, {operand(0), operand(1)});
    default:
      return Symbol::apply(e.op, {operand(0), operand(1), operand(2)});
  }
}

/// The values of a tape, operation by operation. Operands have smaller numbers than what uses them.
std::vector<Symbol> values_of(const tape::Tape& tape, const EntryAt<Symbol>& at) {
  std::vector<Symbol> nodes, values;
  for (int id = 0; id < tape.graph().size(); ++id) {
    const tape::Expression& e = tape.graph()[{id}];
    nodes.push_back(tape::operand_count(e.op) == 0 ? variable(at, e) : applied(e, nodes));
  }
  for (const tape::Node output : tape.outputs()) values.push_back(nodes[output.id]);
  return values;
}

}  // namespace

Formula formula_of(const Slot& slot, bool joins) {
  const Reads reads = slot->tape.reads();
  if (slot->tape.reads_entry()) return {};
  // The slot has the present tape, which may be replaced between two pieces of a run.
  const Formula formula(
      [slot](const At& at, VectorRef out) { slot->tape.evaluate(at, out.data()); },
      [slot](detail::Symbols& symbols) {
        return values_of(slot->tape, EntryAt<Symbol>(symbols, 0));
      });
  const bool alone = has(reads, Reads::discrete_state) || has(reads, Reads::mode);
  return joins && !alone ? formula : formula.called();
}

}  // namespace saltus::python
