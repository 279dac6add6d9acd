// The list of instructions of a series.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::tape::series {

/// A row holds the coefficients of order 1, 2, ... of an expression at those places. The
/// coefficient of order 0 is among the values, because expressions that differ by a constant share
/// a row. A distance of 36 numbers keeps rows apart in the cache.
inline constexpr Index row_size = 36;
/// The row of a constant, which has only zeros.
inline constexpr Index zero_row = 0;
/// The numbers that an instruction keeps during an expansion: two sums for each order of a block,
/// then up to four that `begin` computes.
inline constexpr Index sums_size = 12;

struct Call;
struct Instruction;

/// Executes a call and the following ones up to the next stop. `sums` are the numbers of all
/// instructions.
using Handler = void (*)(const Call* call, double* rows, double* sums, const double* values,
                         Index k);

/// The functions of a recurrence.
struct Handlers {
  Handler begin = nullptr;    ///< when the values are known
  Handler earlier = nullptr;  ///< at the first order k of a block: the sums over orders below k
  Handler orders[8] = {};     ///< order 1, 2, 3 at [1], [2], [3]; k of a later block at [4 + k % 4]
};

class SeriesWriter;

/// Writes one function of a recurrence down, for the instruction whose numbers are at `own`, and
/// for order k.
using WriteHandler = void (*)(SeriesWriter& writer, const Instruction& i, Index own, Index k);

/// The same functions as those of Handlers, for writing. Without orders there is no machine code.
struct WriteHandlers {
  WriteHandler begin = nullptr, earlier = nullptr, orders[8] = {};
};

/// One handler for all orders from 1 on.
constexpr WriteHandlers all_written(WriteHandler handler, WriteHandler begin = nullptr) {
  WriteHandlers made{.begin = begin};
  for (std::size_t slot = 1; slot < 8; ++slot) made.orders[slot] = handler;
  return made;
}

/// The rows that a recurrence needs in each lane.
struct Reads {
  bool a = false, b = false;    ///< all coefficients of an operand, not only the newest
  bool da = false, db = false;  ///< a row of k times the coefficients, which it writes itself
  bool second = false;          ///< a second result
  bool linear = false;          ///< its terms, each from a single lane
};

struct Kernel {
  Handlers narrow, wide;  ///< the wide handlers may be missing
  Reads reads;
  WriteHandlers written = {};
};

/// A multiple of a row.
struct Term {
  Index row = zero_row, factor = 0;  ///< the factor is a value
};

/// Computes a row from others. Rows are offsets in the memory of rows; values are numbers.
struct Instruction {
  const Kernel* kernel = nullptr;
  Index to = 0, to_second = 0;
  Index a = 0, b = 0;        ///< the rows of operands
  Index da = 0, db = 0;      ///< rows of k times the coefficient of order k: of a, b or the result
  Index value = 0;           ///< of the result
  Index of_a = 0, of_b = 0;  ///< the values of operands
  double factor = 1.0;
  Op op = Op::constant;                    ///< of a kinked operation
  Index c = 0, d = 0, of_c = 0, of_d = 0;  ///< of the comparison that decides a select
  Index first_term = 0, terms = 0;         ///< of a combination
  const Term* term = nullptr;
};

/// One call of a handler.
struct Call {
  Handler run = nullptr;
  const Instruction* instruction = nullptr;
  Index own = 0;  ///< where the numbers of the instruction are
};

/// Ends a list of calls.
void stop(const Call*, double*, double*, const double*, Index);

/// Calls that follow one another. They come in pieces that end with a stop: if a compiler makes
/// calls of the jumps between them, as without optimisation, the stack holds no more than a piece.
struct Calls {
  std::vector<Call> all;
  std::vector<std::size_t> starts;

  void append(Handler handler, const Instruction& instruction, Index own);
  void run(double* rows, double* sums, const double* values, Index k) const {
    for (const std::size_t start : starts) all[start].run(&all[start], rows, sums, values, k);
  }
};

/// The calls for all rates, by order.
struct Orders {
  Calls begin, earlier, orders[8];  ///< as in Handlers

  void append(const Handlers& handlers, const Instruction& instruction, Index own);
};

/// A value that an expansion reads from its arguments.
struct Load {
  Op op = Op::constant;
  Index index = 0;
  int port = 0, to = 0;
};

using Function = double (*)(double a, double b, double c);
/// The function that computes the value of an operation.
Function function(Op op);

/// A value that is computed: values[to] = run(values[from[0]], ...).
struct Value {
  Function run = nullptr;
  int to = 0, from[3] = {};
  Op op = Op::constant;
};

/// The coefficient of order k + 1 of a state is that of order k of its rate, divided by k + 1. The
/// rate has a value, and for k >= 1 it is a multiple of a row.
struct Rate {
  Index value = 0;
  Term term;
};

/// An output: the place of its coefficients, and the values and instructions that they need.
struct Output {
  Index row = 0, value = 0;
  std::vector<int> values, instructions;  ///< in ascending order
};

struct Wide;

/// Expands the rates, or all outputs, with memory of a Series; 0 if the interpreter has to do it.
using SeriesFunction = int (*)(double* values, double* rows, double* own, double* x);

/// Machine code for one order. A function that is missing is interpreted.
struct Code {
  int order = 0;
  SeriesFunction states = nullptr, outputs = nullptr;
  std::vector<std::shared_ptr<const void>> owners = {};
};

/// The machine code of a program, if it was given any. It is set once, and other threads may run
/// the program meanwhile.
struct Compiled {
  std::atomic<const Code*> code = nullptr;
  std::unique_ptr<const Code> kept = {};  ///< read by the destructor only
};

/// Never changes once built, except for its machine code. Value i < states is that of state i,
/// whose row is 1 + i.
struct Program {
  std::vector<double> constants;  ///< the values; a value that is not constant is 0
  std::vector<char> is_constant;  ///< of each value
  std::vector<Load> loads;
  std::vector<Value> values;
  std::vector<Instruction> instructions;
  std::vector<Term> terms;  ///< of combinations, which point to them
  Orders calls;
  std::shared_ptr<const Wide> wide;  ///< runs in place of `calls`; null: narrow ones are quicker
  /// The first instructions are for the rates, the others for outputs.
  int first_values = 0, first_instructions = 0;
  std::vector<Rate> rates;
  std::vector<Output> outputs;
  int states = 0, rows = 0;
  Index time_row = zero_row;
  std::shared_ptr<Compiled> compiled = std::make_shared<Compiled>();

  /// The number of instructions that an expansion runs in their narrow form.
  int first_narrow() const { return wide == nullptr ? first_instructions : 0; }
};

/// The program for the `rates` and `outputs` of a Series.
std::shared_ptr<const Program> build(const Graph& graph, std::span<const Node> rates,
                                     std::span<const Node> outputs);

}  // namespace saltus::tape::series
