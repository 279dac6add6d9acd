// MachineCode: a tape as a function of the processor, made by a compiler of the user's choice.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/tape/series.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::tape {

/// The compiled form of a tape. `u` has the inputs that the tape reads, in the order of
/// `Tape::inputs_read()`; `memory` has room for `Tape::memory_size()` numbers.
using MachineFunction = void (*)(const double* x, const double* p, const double* z,
                                 const double* const* u, double time, double mode, double entry,
                                 double* memory, double* out);

/// A function with the object that keeps its memory.
struct MachineCode {
  MachineFunction run = nullptr;
  std::shared_ptr<const void> owner = {};
};

/// A function of <cmath> or of Saltus that machine code calls by name. Interpreted tapes call the
/// same one, so the numbers are the same.
struct CalledFunction {
  std::string_view name;
  const void* address;
};
std::span<const CalledFunction> called_functions();

/// The tapes as text in the intermediate representation of LLVM
/// (https://llvm.org/docs/LangRef.html): tape i is the function "saltus_tape_<i>" of the type
/// above. Every operation is a single one of IEEE 754 or a call of a function of
/// `called_functions()`, without fast-math flags and without contraction. So each number is that of
/// the interpreted tape to the last bit; only the sign and the payload of a NaN may differ. A
/// compiler must keep the order of operations, which LLVM does.
std::string llvm_module(std::span<const Tape> tapes);

/// The same text for series, each to one order: the functions "saltus_tape_<first>" and so on
/// expand the states of a series, and then all its outputs. Sums have the order of the interpreted
/// series, so the numbers have the same bits. A series has no such function if an instruction has
/// none, or if it would be too long. Returns the text, and the number of functions.
std::pair<std::string, int> llvm_module(std::span<const SeriesOrder> series, int first = 0);

/// Compiles a module; returns the functions saltus_tape_0 ... saltus_tape_<count - 1>.
using Compiler = std::function<std::vector<MachineCode>(const std::string& module, int count)>;

/// Gives machine code to the tapes, all of one module, from the next call of `evaluate` on. Threads
/// may run them meanwhile. Tapes that have machine code keep theirs; if all have it, the compiler
/// is not called. ModelError if the compiler returns another number of functions.
void compile(std::span<const Tape> tapes, const Compiler& compiler);
/// The same for tapes and series of one module. The first code of a series stays, whatever its
/// order.
void compile(std::span<const Tape> tapes, std::span<const SeriesOrder> series,
             const Compiler& compiler);

}  // namespace saltus::tape
