// The lines of a program as instructions of LLVM.
#pragma once

#include "llvm_text.hpp"
#include "program.hpp"

namespace saltus::tape::detail {

/// A longer run is a loop. A shorter run is written out, as many lanes at a time as a vector has.
inline constexpr std::size_t longest_written_out = 32;

/// The function `name` of a program, with the type of MachineFunction. `declarations` gets the
/// declarations of the functions that it calls.
std::string llvm_function(const Program& program, const std::string& name,
                          std::set<std::string>& declarations);

}  // namespace saltus::tape::detail
