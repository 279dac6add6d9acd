// The places at which expressions have a kink or a jump.
#pragma once

#include <span>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// A switch is at its limit where a = b: the operands of a comparison, or an operand of abs, and
/// zero. Its numbers are a, b, the sum of the terms of a difference, |p| + |q| of p - q, and its
/// branch: a number that is constant between its kinks or jumps, and differs on both sides of one.
constexpr Index numbers_of_switch = 4;

/// The numbers of all switches that these expressions depend on, as new nodes of the graph.
std::vector<Node> switches_of(Graph& graph, std::span<const Node> rows);

}  // namespace saltus::tape
