// Op: what a node of an expression graph is, with its name and the number of its operands.
#pragma once

#include <optional>
#include <string_view>

namespace saltus::tape {

/// What a node is. All numbers are doubles, a truth is 0.0 or 1.0; any number but 0 counts as true,
/// NaN among them. In Python an operation is called by the word that stands here.
///
/// Every operation gives, to the last bit, what the function of that name in <cmath> gives; NaN and
/// infinity go through as they do in NumPy.
enum class Op : unsigned char {
  // what a graph begins with
  constant,
  time,              ///< [s]
  continuous_state,  ///< x[i]
  discrete_state,    ///< z[i]
  mode,
  entry,      ///< in a reset map: which guard of a vector of them fired
  parameter,  ///< p[i], counted over all parameters of the block
  input,      ///< u[k][i]
  // of one operand
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
  sign,         ///< -1, 0 or 1; of NaN NaN
  logical_not,  ///< 1 for 0, else 0
  // of two
  add,
  sub,
  mul,
  div,
  pow,
  atan2,
  hypot,
  copysign,
  mod,           ///< remainder with the sign of the second operand: Python's %
  fmod,          ///< remainder with the sign of the first
  floor_divide,  ///< Python's //
  minimum,       ///< NaN where one of them is NaN
  maximum,       ///< NaN where one of them is NaN
  lt,
  le,
  gt,
  ge,
  eq,
  ne,
  logical_and,
  logical_or,
  // of three
  select,  ///< select(c, a, b) is a where c is true, else b
};

inline constexpr int operation_count = static_cast<int>(Op::select) + 1;

/// How many nodes an operation takes: 0 for a constant or a variable, else 1, 2 or 3.
constexpr int operand_count(Op op) {
  if (op <= Op::input) return 0;
  if (op <= Op::logical_not) return 1;
  return op == Op::select ? 3 : 2;
}
constexpr bool is_variable(Op op) { return op > Op::constant && op <= Op::input; }
/// An operation whose result is 0 or 1.
constexpr bool is_truth(Op op) {
  return op == Op::logical_not || (op >= Op::lt && op <= Op::logical_or);
}
/// op(a, b) is op(b, a), to the last bit.
constexpr bool is_commutative(Op op) {
  return op == Op::add || op == Op::mul || op == Op::eq || op == Op::ne || op == Op::logical_and ||
         op == Op::logical_or;
}

/// The word for it: "add".
std::string_view name(Op op);
/// The operation of that name; empty if there is none.
std::optional<Op> operation(std::string_view name);
/// As `operation`; ModelError with the nearest known name if there is none.
Op known_operation(std::string_view name);

}  // namespace saltus::tape
