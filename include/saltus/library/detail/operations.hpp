// The operations of a tape in a formula: the same call for numbers, packs and symbols, to the same
// bits.
#pragma once

#include "saltus/base/pack.hpp"
#include "saltus/tape/symbol.hpp"

namespace saltus::detail {

/// The value of an operation with one or two operands.
double operation(tape::Op op, double a);
double operation(tape::Op op, double a, double b);

inline Pack operation(tape::Op op, const Pack& a) {
  return Pack::each([op](double value) { return operation(op, value); }, a);
}
inline Pack operation(tape::Op op, const Pack& a, const Pack& b) {
  return Pack::each([op](double left, double right) { return operation(op, left, right); }, a, b);
}
inline tape::Symbol operation(tape::Op op, const tape::Symbol& a) {
  return tape::Symbol::apply(op, {a});
}
inline tape::Symbol operation(tape::Op op, const tape::Symbol& a, const tape::Symbol& b) {
  return tape::Symbol::apply(op, {a, b});
}

}  // namespace saltus::detail
