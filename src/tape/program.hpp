// The list of instructions behind a tape.
#pragma once

#include <cstdint>
#include <vector>

#include "saltus/base/reads.hpp"
#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::tape::detail {

/// The arrays that an instruction may name. Input number i of those read is at `inputs + i`.
enum Base : std::uint32_t { registers, out, constants, x, z, p, scalars, inputs };

/// The entries of the array `scalars`.
enum Scalar : std::uint32_t { time, mode, entry, scalar_count };

/// One number in one of the arrays.
struct Address {
  std::uint32_t base = registers, offset = 0;
};

struct Instruction;
using Handler = void (*)(const Instruction&, double* const* bases);

/// to = op(from[0], from[1], from[2]); a copy has the Op of a variable.
struct Instruction {
  Handler run = nullptr;
  Op op = Op::constant;
  Address to = {};
  std::array<Address, 3> from = {};
};

/// Never changes once built.
struct Program {
  Graph graph;                ///< what the outputs need, nothing else
  std::vector<Node> outputs;  ///< nodes of `graph`
  std::vector<Instruction> instructions;
  std::vector<double> constants;
  std::vector<int> inputs;    ///< the ports that are read
  std::vector<Index> widths;  ///< how many entries each of them must have
  Index x = 0, z = 0, p = 0;  ///< how many entries the others must have
  std::size_t registers = 0;
  Reads reads = Reads::parameters;
  bool reads_entry = false;
};

Program build(const Graph& graph, std::span<const Node> outputs);
/// The function that carries out an instruction of this operation.
Handler handler(Op op);
void run(const Program& program, const At& at, double* out);

}  // namespace saltus::tape::detail
