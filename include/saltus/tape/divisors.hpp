// Divisors: where expressions may have poles.
#pragma once

#include <span>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// The expressions of the time, without states, whose change of sign may be a pole of `nodes`: the
/// divisor of a quotient, the base of a power that may have a negative exponent, cos(a) for tan(a).
/// A product counts by all its factors, a square or a modulus by its operand. Expressions that
/// cannot change their sign are left out, as exp(a), sqrt(a), 1 + a*a and 2 + sin(a). New nodes may
/// be added to `graph`.
std::vector<Node> divisors(Graph& graph, std::span<const Node> nodes);

}  // namespace saltus::tape
