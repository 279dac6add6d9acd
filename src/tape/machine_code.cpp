// Tapes as text for LLVM, and what machine code calls.
#include "saltus/tape/machine_code.hpp"

#include <array>
#include <string>
#include <utility>

#include "arithmetic.hpp"
#include "llvm_program.hpp"
#include "saltus/base/error.hpp"

namespace saltus::tape {

namespace {

using detail::LlvmText;

template <Op op>
double of_one(double a) {
  return compute(op, a, 0.0, 0.0);
}
template <Op op>
double of_two(double a, double b) {
  return compute(op, a, b, 0.0);
}

template <Op op>
const void* address_of() {
  if constexpr (operand_count(op) == 1)
    return reinterpret_cast<const void*>(&of_one<op>);
  else
    return reinterpret_cast<const void*>(&of_two<op>);
}

/// The functions of these operations, by their names.
template <Op... op>
struct Called {
  static std::vector<CalledFunction> functions() {
    static const std::array<std::string, sizeof...(op)> names{detail::called_name(op)...};
    std::vector<CalledFunction> all;
    std::size_t i = 0;
    (all.push_back({names[i++], address_of<op>()}), ...);
    return all;
  }
};

using AllCalled = Called<Op::cbrt, Op::exp, Op::exp2, Op::expm1, Op::log, Op::log2, Op::log10,
                         Op::log1p, Op::sin, Op::cos, Op::tan, Op::asin, Op::acos, Op::atan,
                         Op::sinh, Op::cosh, Op::tanh, Op::asinh, Op::acosh, Op::atanh, Op::pow,
                         Op::atan2, Op::hypot, Op::mod, Op::fmod, Op::floor_divide>;

}  // namespace

std::span<const CalledFunction> called_functions() {
  static const std::vector<CalledFunction> functions = AllCalled::functions();
  return functions;
}

std::string llvm_module(std::span<const Tape> tapes) {
  std::string functions;
  std::set<std::string> declarations;
  for (std::size_t i = 0; i < tapes.size(); ++i)
    functions += detail::llvm_function(tapes[i].program(), text("saltus_tape_", i), declarations);
  std::string module;
  for (const std::string& declaration : declarations) module += declaration + "\n";
  return module + functions;
}

void compile(std::span<const Tape> tapes, const Compiler& compiler) {
  std::vector<Tape> interpreted;
  for (const Tape& tape : tapes)
    if (!tape.is_machine_code()) interpreted.push_back(tape);
  if (interpreted.empty()) return;
  const int count = static_cast<int>(interpreted.size());
  std::vector<MachineCode> codes = compiler(llvm_module(interpreted), count);
  if (codes.size() != interpreted.size()) {
    throw ModelError(
        text("a compiler of tapes: expected ", count, " functions, found ", codes.size()));
  }
  for (std::size_t i = 0; i < codes.size(); ++i) interpreted[i].run_as(std::move(codes[i]));
}

}  // namespace saltus::tape
