// Running a tape.
#include "program.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::tape {

namespace {

using detail::Instruction, detail::Program;

/// Runs a program of several pieces, with memory of the thread. No tape runs inside another one,
/// because a tape calls no function of a user.
[[gnu::noinline]] void run_large(const Program& program, const At& at, double* out) {
  thread_local std::vector<double> registers;
  if (registers.size() < program.registers) registers.resize(program.registers);
  double before = 0.0;
  for (const std::size_t start : program.starts) {
    const Instruction& first = program.instructions[start];
    before = first.run(&first, before, registers.data(), out, at);
  }
}

}  // namespace

void Tape::evaluate(const At& at, double* out) const {
  const Program& program = *program_;
  if (!program.small) return run_large(program, at, out);
  double registers[detail::small_registers];
  const Instruction* first = program.instructions.data();
  first->run(first, 0.0, registers, out, at);
}

}  // namespace saltus::tape
