// Exact derivatives of expressions, again as expressions, and the places where they are not zero.
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
/// are zero whatever the numbers are. Variables are nodes such as `graph.parameter(2)`; the values
/// are new nodes of the same graph, so they share what they have in common with each other and
/// with the outputs.
///
/// The chain rule is applied to the graph itself (A. Griewank, A. Walther, Evaluating Derivatives,
/// 2nd ed., SIAM 2008): from variables to outputs, one column after the other (forward
/// accumulation, section 3.1), or from outputs to variables, one row after the other (reverse,
/// section 3.2), in each connected part of the graph whichever visits fewer nodes. Only what
/// depends on the variable, or what the output depends on, is visited, which is what makes the
/// result sparse (section 7.1).
///
/// Where an operation has a kink the derivative is one-sided or, where noted, between the sides:
/// abs(a): sign(a), so 0 at 0; minimum, maximum: that of the first operand where both are equal;
/// select: that of the value that is chosen; hypot: 0 at the origin; copysign: as abs; pow(a, b)
/// with respect to b: 0 for a = 0. Of floor, ceil, trunc, rint, sign, floor_divide, comparisons and
/// logical operations it is 0 everywhere; mod and fmod are taken between their jumps. What is not
/// chosen by a select does not reach the result, not even as NaN.
std::vector<Partial> differentiate(Graph& graph, std::span<const Node> outputs,
                                   std::span<const Node> variables);

/// A sparse matrix whose entries are the values of a tape.
struct Jacobian {
  std::vector<MatrixEntry> entries;  ///< column by column; the others are zero
  Tape values;                       ///< of these, in this order
};

/// d(outputs) / d(continuous state): see `differentiate`.
Jacobian jacobian(const Tape& tape);

}  // namespace saltus::tape
