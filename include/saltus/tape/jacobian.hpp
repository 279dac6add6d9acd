// Exact derivatives of expressions, again as expressions, and the entries where they may differ
// from zero.
#pragma once

#include <span>
#include <vector>

#include "saltus/base/matrix_entry.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::tape {

/// d(output[row]) / d(variable[column]).
struct Partial {
  Index row = 0, column = 0;
  Node value;
};

/// The derivatives of `outputs` with respect to `variables`, column by column, without those that
/// are zero for all values. Variables are nodes such as `graph.parameter(2)`. The results are new
/// nodes of the same graph, so they share common expressions with each other and with the outputs.
///
/// The chain rule is applied to the graph itself (A. Griewank, A. Walther, Evaluating Derivatives,
/// 2nd ed., SIAM 2008): from variables to outputs, one column after the other (forward
/// accumulation, section 3.1), or from outputs to variables, one row after the other (reverse,
/// section 3.2). Each connected part of the graph uses the direction that visits fewer nodes. Only
/// nodes that depend on the variable, or that the output depends on, are visited, which makes the
/// result sparse (section 7.1).
///
/// At a kink the derivative is one-sided or, where noted, between the sides. abs(a): sign(a), so 0
/// at 0; minimum, maximum: the derivative of the first operand if both are equal; select: the
/// derivative of the chosen value; hypot: 0 at the origin; copysign: as abs; pow(a, b) with respect
/// to b: 0 for a = 0. The derivative of floor, ceil, trunc, rint, sign, floor_divide, comparisons
/// and logical operations is 0 everywhere; mod and fmod have the derivative between their jumps. A
/// value that a select does not choose does not reach the result, not even as NaN.
std::vector<Partial> differentiate(Graph& graph, std::span<const Node> outputs,
                                   std::span<const Node> variables);

/// A sparse matrix; a tape computes the values of its entries.
struct Jacobian {
  std::vector<MatrixEntry> entries;  ///< column by column; all other entries are zero
  Tape values;                       ///< computes the entries, in this order
};

/// d(outputs) / d(continuous state): see `differentiate`.
Jacobian jacobian(const Tape& tape);

}  // namespace saltus::tape
