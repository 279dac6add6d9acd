// The list of instructions of a tape.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "saltus/base/reads.hpp"
#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"
#include "saltus/tape/machine_code.hpp"

namespace saltus::tape::detail {

/// The place of a number. Any operand of a common operation may be of the first five kinds; a
/// number of another kind is first loaded into a register.
enum class Kind : unsigned char {
  before,    ///< the result of the previous instruction, still in the processor
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

/// One number, or several at equal distances.
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

/// Executes an instruction and the following ones up to the next stop. It takes the result of the
/// previous instruction and returns the last result.
using Handler = double (*)(const Instruction* i, double before, double* registers, double* out,
                           const At& at);

/// A line in the form that runs: for one number the operands themselves, for many a pointer to the
/// line.
struct Instruction {
  Handler run = nullptr;
  union {
    double value = 0.0;  ///< of an operand that is constant
    const Line* line;
  };
  std::uint32_t to = 0, from[3] = {};
};

inline constexpr std::size_t small_registers = 128;

/// Machine code of a program, if it was given any. It is set once, and other threads may run the
/// program meanwhile.
struct Compiled {
  std::atomic<MachineFunction> run = nullptr;
  std::shared_ptr<const void> owner = {};  ///< read by the destructor only
};

/// Never changes once built, except for its machine code.
struct Program {
  Graph graph;                ///< only the nodes that the outputs need
  std::vector<Node> outputs;  ///< nodes of `graph`
  std::deque<Line> lines;     ///< a deque: instructions point to them
  std::vector<Instruction> instructions;
  std::vector<std::size_t> starts;  ///< first instruction of each piece between two stops
  std::vector<int> inputs;          ///< the ports that are read
  std::vector<Index> widths;        ///< the number of entries that each port must have
  Index x = 0, z = 0, p = 0;        ///< the number of entries of the other arrays
  std::size_t registers = 0;
  bool small = false;  ///< one piece, whose registers fit on the stack
  Reads reads = Reads::parameters;
  bool reads_entry = false;
  mutable Compiled compiled;
};

/// Fills the program. Value i goes to places[i]; without places it goes to i.
void build(Program& program, const Graph& graph, std::span<const Node> outputs,
           std::span<const Index> places);

/// Whether an operation takes operands of the first five kinds; the others take registers only.
bool takes_any(Op op);
/// Fills `instructions` and `starts` from `lines`.
void encode(Program& program);
/// The function for a line of several numbers.
Handler vector_handler(Op op);

}  // namespace saltus::tape::detail
