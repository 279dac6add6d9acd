// The expansion of a series as functions of LLVM.
#pragma once

#include <set>
#include <string>

#include "program.hpp"

namespace saltus::tape::series {

/// The function `name`, of the type of SeriesFunction, which expands the rates to this order; empty
/// if an instruction has no machine code, or if the text would be too long. Sums have the order of
/// the interpreted instructions, so the numbers have the same bits. `declarations` gets the
/// declarations of the functions that it calls.
std::string llvm_states(const Program& program, int order, const std::string& name,
                        std::set<std::string>& declarations);
/// The same for all outputs, after the expansion of the rates.
std::string llvm_outputs(const Program& program, int order, const std::string& name,
                         std::set<std::string>& declarations);

}  // namespace saltus::tape::series
