// Whether machine code of tapes pays: measured costs, and the decision.
#pragma once

#include <cstddef>

namespace saltus::tape {

/// The time that machine code saves, which is the time of interpreting beyond the computation
/// itself, and the time of making machine code. They were measured by bench/jit.py with LLVM 22 on
/// an x86-64 processor of 2024, in processor time.
struct CompileCost {
  double instruction = 1e-9;  ///< [s] one interpreted instruction, without libm
  double module = 5e-3;       ///< [s] a module, whatever its size: 4.5 to 6 ms
  double line = 60e-6;  ///< [s] each instruction in the module: 10 us alone, 70 us with runs of ten
  double series_instruction = 2e-9;  ///< [s] an instruction of a series, for one order: 2 to 4 ns
  double series_line = 15e-6;  ///< [s] the same in a module, times the order squared: 12 to 28 us
  double loading = 60e-3;      ///< [s] loading the compiler, once a process: 53 to 58 ms
};

/// [s] The time to compile tapes of so many instructions together.
constexpr double compile_time(double instructions, bool compiler_is_loaded,
                              const CompileCost& cost = {}) {
  return cost.module + cost.line * instructions + (compiler_is_loaded ? 0.0 : cost.loading);
}

/// Whether to compile. The answer is yes once interpreting has cost as much as compiling will cost.
/// Nobody knows how many calls will follow. With this rule the time of both is at most twice the
/// time of the better choice, whatever follows (the ski rental problem; A. R. Karlin et al.,
/// Competitive snoopy caching, Algorithmica 3 (1988) 79-119).
constexpr bool compiling_pays(double interpreted_instructions, double instructions,
                              bool compiler_is_loaded, const CompileCost& cost = {}) {
  return cost.instruction * interpreted_instructions >=
         compile_time(instructions, compiler_is_loaded, cost);
}

}  // namespace saltus::tape
