// The compiler of tapes: llvmlite, through python/saltus/jit/.
#pragma once

#include <span>

#include "saltus/tape/series.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::python {

/// Whether this process has made machine code already, so that llvmlite is imported.
bool compiler_is_loaded() noexcept;

/// Compiles what is not compiled yet, under the lock of the interpreter. If llvmlite is missing or
/// fails, the tapes stay interpreted; ModelError if `required`.
void compile_tapes(std::span<const tape::Tape> tapes, std::span<const tape::SeriesOrder> series,
                   bool required);

}  // namespace saltus::python
