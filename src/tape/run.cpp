// Running a tape: one function for each operation, called one after the other.
#include <array>
#include <utility>

#include "arithmetic.hpp"
#include "program.hpp"

namespace saltus::tape::detail {

namespace {

template <Op op>
void carry_out(const Instruction& i, double* const* bases) {
  const auto from = [&](std::size_t k) { return bases[i.from[k].base][i.from[k].offset]; };
  const double a = from(0);
  const double b = operand_count(op) > 1 ? from(1) : 0.0;
  const double c = operand_count(op) > 2 ? from(2) : 0.0;
  bases[i.to.base][i.to.offset] = compute(op, a, b, c);
}

constexpr auto handlers = []<std::size_t... op>(std::index_sequence<op...>) {
  return std::array<Handler, sizeof...(op)>{&carry_out<static_cast<Op>(op)>...};
}(std::make_index_sequence<operation_count>{});

constexpr std::size_t small_registers = 128, small_inputs = 8;

/// Memory of a thread for tapes that need more than the stack should give.
struct Scratch {
  std::vector<double> registers;
  std::vector<double*> bases;
};
thread_local Scratch scratch;

double* writable(const double* numbers) { return const_cast<double*>(numbers); }

void run_in(const Program& program, const At& at, double* target, double* memory, double** bases) {
  std::array<double, scalar_count> numbers{at.time, static_cast<double>(at.mode),
                                           static_cast<double>(at.entry)};
  bases[registers] = memory;
  bases[out] = target;
  bases[constants] = writable(program.constants.data());
  bases[x] = writable(at.x.data());
  bases[z] = writable(at.z.data());
  bases[p] = writable(at.p.data());
  bases[scalars] = numbers.data();
  double** base = bases + inputs;
  for (const int port : program.inputs) *base++ = writable(at.u[port].data());
  for (const Instruction& i : program.instructions) i.run(i, bases);
}

}  // namespace

Handler handler(Op op) { return handlers[static_cast<std::size_t>(op)]; }

void run(const Program& program, const At& at, double* target) {
  if (program.registers <= small_registers && program.inputs.size() <= small_inputs) {
    double memory[small_registers];
    double* bases[inputs + small_inputs];
    return run_in(program, at, target, memory, bases);
  }
  if (scratch.registers.size() < program.registers) scratch.registers.resize(program.registers);
  if (scratch.bases.size() < inputs + program.inputs.size()) {
    scratch.bases.resize(inputs + program.inputs.size());
  }
  run_in(program, at, target, scratch.registers.data(), scratch.bases.data());
}

}  // namespace saltus::tape::detail
