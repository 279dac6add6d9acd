// Turns lines into instructions; each kind of operand has its own function.
#include <algorithm>
#include <array>
#include <utility>

#include "arithmetic.hpp"
#include "program.hpp"
#include "saltus/base/list.hpp"

namespace saltus::tape::detail {

namespace {

/// Runs the next instruction, as a jump if the compiler sees that nothing is left to do here.
#define SALTUS_TAPE_NEXT(computed) return i[1].run(i + 1, computed, registers, out, at)

template <Kind kind>
[[gnu::always_inline]] inline double read(const Instruction* i, std::size_t k, double before,
                                          const double* registers, const At& at) {
  const auto from = static_cast<Index>(i->from[k]);
  switch (kind) {
    case Kind::before:
      return before;
    case Kind::reg:
      return registers[from];
    case Kind::constant:
      return i->value;
    case Kind::x:
      return at.x.data()[from];
    case Kind::p:
      return at.p.data()[from];
    case Kind::z:
      return at.z.data()[from];
    case Kind::input:
      return at.u[static_cast<int>(i->from[2])].data()[from];
    case Kind::time:
      return at.time;
    case Kind::mode:
      return static_cast<double>(at.mode);
    default:
      return static_cast<double>(at.entry);
  }
}

/// The kinds of both operands (of the first five), the operation and the destination are known at
/// compile time, so one load for each operand, the operation and one store are left.
template <Op op, bool to_out, Kind a, Kind b>
double common(const Instruction* i, double before, double* registers, double* out, const At& at) {
  const double of_a = read<a>(i, 0, before, registers, at);
  const double of_b = operand_count(op) > 1 ? read<b>(i, 1, before, registers, at) : 0.0;
  const double result = compute(op, of_a, of_b, 0.0);
  (to_out ? out : registers)[i->to] = result;
  SALTUS_TAPE_NEXT(result);
}

template <Op op, bool to_out>
double other(const Instruction* i, double, double* registers, double* out, const At& at) {
  const double result =
      compute(op, registers[i->from[0]], registers[i->from[1]], registers[i->from[2]]);
  (to_out ? out : registers)[i->to] = result;
  SALTUS_TAPE_NEXT(result);
}

/// Ends a piece of the tape. Pieces are short: if a compiler makes calls of the jumps above, as
/// without optimisation, the stack holds no more than one piece.
double stop(const Instruction*, double before, double*, double*, const At&) { return before; }
constexpr std::size_t longest_piece = 256;

constexpr std::array common_of_two = {Op::add,     Op::sub,     Op::mul, Op::div,
                                      Op::minimum, Op::maximum, Op::lt,  Op::le};
constexpr std::size_t kinds = 5;

constexpr std::size_t number(Kind kind) { return static_cast<std::size_t>(kind); }
constexpr std::size_t number(Op op) { return static_cast<std::size_t>(op); }
template <std::size_t n>
using Numbers = std::make_index_sequence<n>;

/// The functions of one operation with two operands, by the kinds of both.
template <Op op, bool to_out, std::size_t... pair>
constexpr auto by_kinds(std::index_sequence<pair...>) {
  return std::array<Handler, kinds * kinds>{
      &common<op, to_out, static_cast<Kind>(pair / kinds), static_cast<Kind>(pair % kinds)>...};
}
template <bool to_out, std::size_t... o>
constexpr auto tables_of_two(std::index_sequence<o...>) {
  return std::array{by_kinds<common_of_two[o], to_out>(Numbers<kinds * kinds>{})...};
}

/// The functions of one operation with one operand, or of a copy (from any kind), by its kind.
template <Op op, bool to_out, std::size_t... kind>
constexpr auto by_kind(std::index_sequence<kind...>) {
  return std::array<Handler, sizeof...(kind)>{
      &common<op, to_out, static_cast<Kind>(kind), Kind::before>...};
}
constexpr std::size_t unary_count = number(Op::logical_not) - number(Op::neg) + 1;
template <bool to_out, std::size_t... o>
constexpr auto tables_of_one(std::index_sequence<o...>) {
  return std::array{by_kind<static_cast<Op>(number(Op::neg) + o), to_out>(Numbers<kinds>{})...};
}

template <bool to_out, std::size_t... o>
constexpr auto table_of_others(std::index_sequence<o...>) {
  return std::array<Handler, sizeof...(o)>{&other<static_cast<Op>(number(Op::add) + o), to_out>...};
}

template <bool to_out>
Handler handler(const Line& line) {
  static constexpr auto copies = by_kind<Op::constant, to_out>(Numbers<number(Kind::out)>{});
  static constexpr auto of_one = tables_of_one<to_out>(Numbers<unary_count>{});
  static constexpr auto of_two = tables_of_two<to_out>(Numbers<common_of_two.size()>{});
  static constexpr auto others =
      table_of_others<to_out>(Numbers<operation_count - number(Op::add)>{});
  const std::size_t first = number(line.from[0].kind), second = number(line.from[1].kind);
  if (line.op == Op::constant) return copies[first];
  if (operand_count(line.op) == 1) return of_one[number(line.op) - number(Op::neg)][first];
  const auto found = std::ranges::find(common_of_two, line.op);
  if (found == common_of_two.end()) return others[number(line.op) - number(Op::add)];
  return nth(of_two, found - common_of_two.begin())[first * kinds + second];
}

Instruction stopping() {
  Instruction i;
  i.run = &stop;
  return i;
}

Instruction encoded(const Line& line) {
  Instruction i;
  if (line.count > 1) {
    i.run = vector_handler(line.op);
    i.line = &line;
    return i;
  }
  i.run = line.to.kind == Kind::out ? handler<true>(line) : handler<false>(line);
  i.to = line.to.offset;
  for (std::size_t k = 0; k < line.operands(); ++k) {
    i.from[k] = line.from[k].offset;
    if (line.from[k].kind == Kind::constant) i.value = line.from[k].value;
  }
  if (line.from[0].kind == Kind::input) i.from[2] = static_cast<std::uint32_t>(line.from[0].port);
  return i;
}

}  // namespace

bool takes_any(Op op) {
  return operand_count(op) < 2 || std::ranges::find(common_of_two, op) != common_of_two.end();
}

void encode(Program& program) {
  std::size_t length = longest_piece;
  for (const Line& line : program.lines) {
    if (length == longest_piece) {
      if (!program.instructions.empty()) program.instructions.push_back(stopping());
      program.starts.push_back(program.instructions.size());
      length = 0;
    }
    program.instructions.push_back(encoded(line));
    ++length;
  }
  program.instructions.push_back(stopping());
  program.small = program.starts.size() <= 1 && program.registers <= small_registers;
}

}  // namespace saltus::tape::detail
