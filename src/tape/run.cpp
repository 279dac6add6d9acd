// Running a tape.
#include "program.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::tape {

namespace {

using detail::Instruction, detail::Program;

/// Memory of the thread for the registers of a large program. No tape runs inside another one,
/// because a tape calls no function of a user.
double* registers_of(const Program& program) {
  thread_local std::vector<double> registers;
  if (registers.size() < program.registers) registers.resize(program.registers);
  return registers.data();
}

/// Runs a program of several pieces.
[[gnu::noinline]] void run_large(const Program& program, const At& at, double* out) {
  double* const registers = registers_of(program);
  double before = 0.0;
  for (const std::size_t start : program.starts) {
    const Instruction& first = program.instructions[start];
    before = first.run(&first, before, registers, out, at);
  }
}

void run_compiled(MachineFunction run, const Program& program, const double* const* u, const At& at,
                  double* out) {
  double registers[detail::small_registers];
  double* const memory = program.small ? registers : registers_of(program);
  run(at.x.data(), at.p.data(), at.z.data(), u, at.time, static_cast<double>(at.mode),
      static_cast<double>(at.entry), memory, out);
}

/// With more inputs than fit on the stack.
[[gnu::noinline]] void run_wide(MachineFunction run, const Program& program, const At& at,
                                double* out) {
  thread_local std::vector<const double*> inputs;
  inputs.clear();
  for (const int port : program.inputs) inputs.push_back(at.u[port].data());
  run_compiled(run, program, inputs.data(), at, out);
}

void run_code(MachineFunction run, const Program& program, const At& at, double* out) {
  constexpr std::size_t few = 8;
  const std::size_t count = program.inputs.size();
  if (count > few) return run_wide(run, program, at, out);
  const double* inputs[few];
  for (std::size_t i = 0; i < count; ++i) inputs[i] = at.u[program.inputs[i]].data();
  run_compiled(run, program, inputs, at, out);
}

}  // namespace

void Tape::evaluate(const At& at, double* out) const {
  const Program& program = *program_;
  if (const MachineFunction run = program.compiled.run.load(std::memory_order_acquire))
    return run_code(run, program, at, out);
  if (!program.small) return run_large(program, at, out);
  double registers[detail::small_registers];
  const Instruction* first = program.instructions.data();
  first->run(first, 0.0, registers, out, at);
}

}  // namespace saltus::tape
