// Op: the operation of a node in an expression graph, its name and the number of its operands.
#pragma once

#include <optional>
#include <string_view>

namespace saltus::tape {

/// The operation of a node. All numbers are doubles; a truth is 0.0 or 1.0, and any number except 0
/// counts as true, including NaN. Python names an operation by the word used here.
///
/// Every operation gives, to the last bit, the result of the <cmath> function of its name, except
/// `pow` with some exponents, see Graph. NaN and infinity propagate as in NumPy.
enum class Op : unsigned char {
  // the leaves of a graph
  constant,
  time,              ///< [s]
  continuous_state,  ///< x[i]
  discrete_state,    ///< z[i]
  mode,
  entry,      ///< in a reset map: the index of the guard that fired, in a vector of guards
  parameter,  ///< p[i], counted over all parameters of the block
  input,      ///< u[k][i]
  // one operand
  neg,
  abs,
  sqrt,
  cbrt,
  exp,
  exp2,
  expm1,
  log,
  log2,
  log10,
  log1p,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  floor,
  ceil,
  trunc,
  rint,         ///< to the nearest whole number, halves to the even one
  sign,         ///< -1, 0 or 1; NaN for NaN
  logical_not,  ///< 1 for 0, otherwise 0
  // two operands
  add,
  sub,
  mul,
  div,
  pow,
  atan2,
  hypot,
  copysign,
  mod,           ///< remainder with the sign of the second operand: Python's %
  fmod,          ///< remainder with the sign of the first operand
  floor_divide,  ///< Python's //
  minimum,       ///< NaN if an operand is NaN
  maximum,       ///< NaN if an operand is NaN
  lt,
  le,
  gt,
  ge,
  eq,
  ne,
  logical_and,
  logical_or,
  // three operands
  select,  ///< select(c, a, b) is a if c is true, otherwise b
};

inline constexpr int operation_count = static_cast<int>(Op::select) + 1;

/// The number of operands of an operation: 0 for a constant or a variable, otherwise 1, 2 or 3.
constexpr int operand_count(Op op) {
  if (op <= Op::input) return 0;
  if (op <= Op::logical_not) return 1;
  return op == Op::select ? 3 : 2;
}
constexpr bool is_variable(Op op) { return op > Op::constant && op <= Op::input; }
/// Whether the result of the operation is 0 or 1.
constexpr bool is_truth(Op op) {
  return op == Op::logical_not || (op >= Op::lt && op <= Op::logical_or);
}
/// Whether op(a, b) is op(b, a), to the last bit.
constexpr bool is_commutative(Op op) {
  return op == Op::add || op == Op::mul || op == Op::eq || op == Op::ne || op == Op::logical_and ||
         op == Op::logical_or;
}

/// The name of the operation: "add".
std::string_view name(Op op);
/// The operation with this name; empty if there is none.
std::optional<Op> operation(std::string_view name);
/// The operation of that name. Throws ModelError with the nearest known name if there is none.
Op known_operation(std::string_view name);

}  // namespace saltus::tape
