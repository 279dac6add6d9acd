// Tapes as text for LLVM, and the functions that machine code calls.
#include "saltus/tape/machine_code.hpp"

#include <array>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "arithmetic.hpp"
#include "llvm_program.hpp"
#include "saltus/base/error.hpp"
#include "series/program.hpp"
#include "series/write.hpp"

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

namespace {

using Declarations = std::set<std::string>;

std::string with(const Declarations& declarations, const std::string& functions) {
  std::string module;
  for (const std::string& declaration : declarations) module += declaration + "\n";
  return module + functions;
}
std::string name_of(int function) { return text("saltus_tape_", function); }

std::string functions_of(std::span<const Tape> tapes, Declarations& declarations) {
  std::string functions;
  for (int i = 0; const Tape& tape : tapes)
    functions += detail::llvm_function(tape.program(), name_of(i++), declarations);
  return functions;
}

/// The functions of a series in a module, by number; negative if there is none.
struct Numbers {
  int states = -1, outputs = -1;
};

std::string functions_of(std::span<const SeriesOrder> all, int& next, std::vector<Numbers>& numbers,
                         Declarations& declarations) {
  std::string functions;
  const auto append = [&](const std::string& function) {
    functions += function;
    return function.empty() ? -1 : next++;
  };
  for (const auto& [program, order] : all) {
    Numbers& of = numbers.emplace_back();
    of.states = append(series::llvm_states(*program, order, name_of(next), declarations));
    if (of.states >= 0)
      of.outputs = append(series::llvm_outputs(*program, order, name_of(next), declarations));
  }
  return functions;
}

/// Gives a series its code; another thread may have done so.
void run_as(const SeriesOrder& one, const Numbers& numbers, std::span<const MachineCode> codes) {
  static std::mutex one_at_a_time;
  const std::scoped_lock lock(one_at_a_time);
  series::Compiled& compiled = *one.program->compiled;
  if (compiled.kept != nullptr) return;
  auto code = std::make_unique<series::Code>();
  code->order = one.order;
  const auto function = [&](int number) -> series::SeriesFunction {
    if (number < 0) return nullptr;
    const MachineCode& made = codes[static_cast<std::size_t>(number)];
    code->owners.push_back(made.owner);
    const auto run = reinterpret_cast<void (*)()>(made.run);  // of any type
    return reinterpret_cast<series::SeriesFunction>(run);
  };
  code->states = function(numbers.states);
  code->outputs = function(numbers.outputs);
  compiled.kept = std::move(code);
  compiled.code.store(compiled.kept.get(), std::memory_order_release);
}

}  // namespace

std::string llvm_module(std::span<const Tape> tapes) {
  Declarations declarations;
  const std::string functions = functions_of(tapes, declarations);
  return with(declarations, functions);
}

std::pair<std::string, int> llvm_module(std::span<const SeriesOrder> series, int first) {
  Declarations declarations;
  std::vector<Numbers> numbers;
  int next = first;
  const std::string functions = functions_of(series, next, numbers, declarations);
  return {with(declarations, functions), next - first};
}

void compile(std::span<const Tape> tapes, const Compiler& compiler) {
  compile(tapes, {}, compiler);
}

void compile(std::span<const Tape> tapes, std::span<const SeriesOrder> series,
             const Compiler& compiler) {
  std::vector<Tape> interpreted;
  for (const Tape& tape : tapes)
    if (!tape.is_machine_code()) interpreted.push_back(tape);
  std::vector<SeriesOrder> expanded;
  for (const SeriesOrder& one : series)
    if (one.program->compiled->code.load(std::memory_order_acquire) == nullptr)
      expanded.push_back(one);
  Declarations declarations;
  std::vector<Numbers> numbers;
  int count = static_cast<int>(interpreted.size());
  std::string functions = functions_of(interpreted, declarations);
  functions += functions_of(expanded, count, numbers, declarations);
  if (count == 0) return;
  std::vector<MachineCode> codes = compiler(with(declarations, functions), count);
  if (codes.size() != static_cast<std::size_t>(count)) {
    throw ModelError(
        text("a compiler of tapes: expected ", count, " functions, found ", codes.size()));
  }
  for (std::size_t i = 0; i < expanded.size(); ++i) run_as(expanded[i], numbers[i], codes);
  for (std::size_t i = 0; i < interpreted.size(); ++i) interpreted[i].run_as(std::move(codes[i]));
}

}  // namespace saltus::tape
