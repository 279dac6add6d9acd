// The list of instructions behind a tape.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "saltus/base/reads.hpp"
#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::tape::detail {

/// Where a number is. The first five may stand in any operand of common operations; the others are
/// loaded into a register first.
enum class Kind : unsigned char {
  before,    ///< what the instruction before has computed: it is still in the processor
  reg,       ///< scratch memory
  constant,  ///< in the instruction itself
  x,
  p,
  z,
  input,
  time,
  mode,
  entry,
  out,  ///< written, never read
};

/// One number, or several with a stride between them.
struct Place {
  Kind kind = Kind::reg;
  std::uint32_t offset = 0;
  std::int32_t stride = 0;
  int port = 0;        ///< of an input
  double value = 0.0;  ///< of a constant
};

/// to[i] = op(from[0][i], ...) for i = 0 ... count - 1; a copy has the Op `constant`.
struct Line {
  Op op = Op::constant;
  Place to = {};
  std::array<Place, 3> from = {};
  std::size_t count = 1;

  std::size_t operands() const {
    return op == Op::constant ? 1 : static_cast<std::size_t>(operand_count(op));
  }
};

struct Instruction;

/// Carries out an instruction and those after it up to the next stop; takes what the instruction
/// before has computed, gives what the last one has.
using Handler = double (*)(const Instruction* i, double before, double* registers, double* out,
                           const At& at);

/// A line for the processor: one number at a time, or `line` for many.
struct Instruction {
  Handler run = nullptr;
  union {
    double value = 0.0;  ///< of an operand that is constant
    const Line* line;
  };
  std::uint32_t to = 0, from[3] = {};
};

inline constexpr std::size_t small_registers = 128;

/// Never changes once built.
struct Program {
  Graph graph;                ///< what the outputs need, nothing else
  std::vector<Node> outputs;  ///< nodes of `graph`
  std::deque<Line> lines;     ///< a deque: instructions point to them
  std::vector<Instruction> instructions;
  std::vector<std::size_t> starts;  ///< of the pieces between two stops
  std::vector<int> inputs;          ///< the ports that are read
  std::vector<Index> widths;        ///< how many entries each of them must have
  Index x = 0, z = 0, p = 0;        ///< how many entries the others must have
  std::size_t registers = 0;
  bool small = false;  ///< one piece, with registers that the stack holds
  Reads reads = Reads::parameters;
  bool reads_entry = false;
};

/// Fills everything. Value i goes to places[i]; without places, to i.
void build(Program& program, const Graph& graph, std::span<const Node> outputs,
           std::span<const Index> places);

/// Whether an operation takes operands of the first five kinds; others take registers only.
bool takes_any(Op op);
/// Fills `instructions` and `starts` from `lines`.
void encode(Program& program);
/// The function for a line of several numbers.
Handler vector_handler(Op op);

}  // namespace saltus::tape::detail
