// Tape: expressions as a list of instructions, which run without an interpreter.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "saltus/base/callback.hpp"
#include "saltus/base/reads.hpp"
#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"

namespace saltus::tape {

struct MachineCode;
namespace detail {
struct Program;
}

/// Computes some expressions of a graph by a list of instructions: only the nodes that they need,
/// each common expression once, operands first. A tape is a value and cheap to copy. Copies share
/// the list, which never changes, so threads may run it at the same time.
class Tape {
 public:
  Tape(const Graph& graph, std::span<const Node> outputs) : Tape(graph, outputs, {}) {}
  /// As above, with a place in `out` for each value.
  Tape(const Graph& graph, std::span<const Node> outputs, std::span<const Index> places);

  /// Writes the `size()` values to `out`, in order or each to its place; `out` must not overlap the
  /// arrays of `at`. Variables are read from `at` when they are needed; `check` tests that `at` has
  /// them, this function does not. Nothing is allocated after the first call of a thread.
  void evaluate(const At& at, double* out) const;
  void operator()(const At& at, VectorRef out) const { evaluate(at, out.data()); }

  /// Throws ModelError if the tape reads a state, parameter or input that `at` does not have.
  void check(const At& at) const;

  Index size() const noexcept;             ///< the number of values
  int instruction_count() const noexcept;  ///< the number of instructions in a call
  Reads reads() const noexcept;            ///< the kinds of values that the results depend on
  bool reads_input(int k) const noexcept;  ///< whether a result depends on input k
  bool reads_parameter() const noexcept;   ///< whether a result depends on a parameter
  bool reads_entry() const noexcept;       ///< whether a result depends on at.entry
  /// The entries of the continuous state that each value depends on, in ascending order.
  std::vector<std::vector<int>> states_read() const;
  const Graph& graph() const noexcept;  ///< the part of the graph that the values need
  const std::vector<Node>& outputs() const noexcept;  ///< the values, as nodes of `graph()`

  /// The inputs that the results depend on, without order.
  const std::vector<int>& inputs_read() const noexcept;

  /// Runs this machine code from now on, see `compile` in machine_code.hpp. The code must give the
  /// same numbers. If a tape gets machine code twice, the first code stays. It is released with the
  /// last tape that shares the list.
  void run_as(MachineCode code) const;
  bool is_machine_code() const noexcept;     ///< whether it runs as machine code
  std::size_t memory_size() const noexcept;  ///< how many numbers machine code needs room for

  /// One line for each instruction, in the order in which they run, and one for each output.
  std::string to_string() const;

  const detail::Program& program() const noexcept { return *program_; }  ///< of this layer only

 private:
  std::shared_ptr<const detail::Program> program_;
};

/// A function of a leaf: the values of a tape as a derivative, an output or a guard.
inline VectorFunction as_vector_function(Tape tape) { return VectorFunction(std::move(tape)); }

}  // namespace saltus::tape
