// The values and the instructions that each output of a program needs.
#pragma once

#include "program.hpp"

namespace saltus::tape::series {

/// Appends the values that an instruction reads, as nodes.
void append_values(std::vector<Node>& nodes, const Instruction& i);

/// Fills the values and the instructions of each output. `places` has the place of the value of
/// each node among the values of the program, or -1.
void find_needs(Program& program, const Graph& graph, const std::vector<int>& places);

}  // namespace saltus::tape::series
