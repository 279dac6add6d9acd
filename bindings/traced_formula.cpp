#include "traced_formula.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace saltus::python {

namespace {

using tape::Op;
using tape::Symbol;

Symbol mode(const EntryAt<Symbol>& at) { return at.mode(); }
/// A formula that reads the mode is never called with numbers: see formula_of.
Symbol mode(const EntryAt<double>&) { return std::numeric_limits<double>::quiet_NaN(); }

/// A variable or a constant of a tape, as the formula of a block reads it.
template <class Number>
Symbol variable(const EntryAt<Number>& at, const tape::Expression& e) {
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
      return mode(at);
    case Op::parameter:
      return at.p(ParameterIndex{e.index, 1}, 0);
    default:
      return at.u(e.port, e.index);
  }
}

Symbol applied(const tape::Expression& e, const std::vector<Symbol>& values) {
  const auto operand = [&](std::size_t k) {
    return values[static_cast<std::size_t>(e.operands[k].id)];
  };
  switch (tape::operand_count(e.op)) {
    case 1:
      return Symbol::apply(e.op, {operand(0)});
    case 2:
      return Symbol::apply(e.op, {operand(0), operand(1)});
    default:
      return Symbol::apply(e.op, {operand(0), operand(1), operand(2)});
  }
}

/// Value i of a tape, operation by operation. Operands have smaller numbers than what uses them.
template <class Number>
Symbol value(const tape::Tape& tape, const EntryAt<Number>& at, Index i) {
  const tape::Node last = tape.outputs()[static_cast<std::size_t>(i)];
  std::vector<Symbol> values;
  for (int id = 0; id <= last.id; ++id) {
    const tape::Expression& e = tape.graph()[{id}];
    values.push_back(tape::operand_count(e.op) == 0 ? variable(at, e) : applied(e, values));
  }
  return values.back();
}

/// The slot has the present tape, which may be another one later in a run in pieces.
struct TracedEntry {
  Slot slot;

  Symbol operator()(const EntryAt<Symbol>& at, Index i) const { return value(slot->tape, at, i); }
  double operator()(const EntryAt<double>& at, Index i) const {
    tape::Graph constants;  // the value is one
    return *constants.value(value(slot->tape, at, i).in(constants));
  }
};

}  // namespace

Formula formula_of(const Slot& slot, bool joins) {
  const Reads reads = slot->tape.reads();
  if (slot->tape.reads_entry()) return {};
  const Formula formula = TracedEntry{slot};
  const bool alone = has(reads, Reads::discrete_state) || has(reads, Reads::mode);
  return joins && !alone ? formula : formula.called();
}

}  // namespace saltus::python
