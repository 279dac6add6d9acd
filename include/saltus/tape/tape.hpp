// Tape: expressions as a list of instructions, to be run without an interpreter.
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

namespace detail {
struct Program;
}

/// The values of some expressions of a graph, computed by a list of instructions: only what these
/// need, each common expression once, in an order in which operands come first. A tape is a value,
/// cheap to copy; copies share the list, which never changes, so threads may run it at once.
class Tape {
 public:
  Tape(const Graph& graph, std::span<const Node> outputs) : Tape(graph, outputs, {}) {}
  /// The same, with the place of each value behind `out`.
  Tape(const Graph& graph, std::span<const Node> outputs, std::span<const Index> places);

  /// Writes the `size()` values to `out`, one after the other or each to its place, which must not
  /// overlap what `at` shows. Variables are read from `at` as they are needed; what they must hold
  /// is not checked here, see `check`. Nothing is allocated after the first call of a thread.
  void evaluate(const At& at, double* out) const;
  void operator()(const At& at, VectorRef out) const { evaluate(at, out.data()); }

  /// ModelError if it reads a state, parameter or input that `at` does not have.
  void check(const At& at) const;

  Index size() const noexcept;             ///< how many values
  int instruction_count() const noexcept;  ///< how many instructions a call runs
  Reads reads() const noexcept;            ///< what the values depend on
  bool reads_input(int k) const noexcept;  ///< whether one of them depends on input k
  bool reads_parameter() const noexcept;   ///< whether one of them depends on a parameter
  bool reads_entry() const noexcept;       ///< whether one of them depends on at.entry
  const Graph& graph() const noexcept;     ///< what it was made from, only what is needed
  const std::vector<Node>& outputs() const noexcept;  ///< the values, as nodes of `graph()`

  /// One line for each instruction, in the order in which they run, and one for each output.
  std::string to_string() const;

 private:
  std::shared_ptr<const detail::Program> program_;
};

/// A function of a leaf: the values of a tape as a derivative, an output or a guard.
inline VectorFunction as_vector_function(Tape tape) { return VectorFunction(std::move(tape)); }

}  // namespace saltus::tape
