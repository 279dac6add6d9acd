// Runs functions of LLVM that are text, without LLVM: straight lines with branches, as the
// expansion of a series has them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "saltus/tape/machine_code.hpp"

namespace support {

/// A compiler for tests. Its functions, at most 64 in a process, read their text line by line with
/// each call; each has four arrays as arguments and returns a number. std::runtime_error at a line
/// that it does not know.
std::vector<saltus::tape::MachineCode> run_as_text(const std::string& module, int count);

}  // namespace support
