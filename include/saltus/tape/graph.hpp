// Graph: expressions over the time, states, parameters and inputs of a block. Equal ones are one
// node.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "saltus/base/ids.hpp"
#include "saltus/tape/operation.hpp"

namespace saltus::tape {

/// Names one expression of a graph. Operands have smaller numbers than what is made of them.
struct Node {
  int id = -1;
  auto operator<=>(const Node&) const = default;
};

/// What a node stands for.
struct Expression {
  Op op = Op::constant;
  std::array<Node, 3> operands = {};  ///< as many as `operand_count(op)`
  double value = 0.0;                 ///< of a constant
  Index index = 0;                    ///< of a variable: which entry
  int port = 0;                       ///< of an input: which one
};

/// Expressions, made from small to large.
///
/// Asking twice for the same expression gives the same node, with the operands of `add`, `mul` and
/// the like in any order. What has only constants in it is computed at once, by the functions that
/// a tape runs. Beyond that only identities that hold to the last bit, signs of zeros and NaN
/// among them, make an expression shorter: x*1, x - 0, -(-x), x/2 = x*0.5, select of a constant.
/// `gt` and `ge` become `lt` and `le` with their operands exchanged.
///
/// One rule changes bits: `pow` with the constant exponent 2, 0.5 or -1 becomes x*x, sqrt(x), 1/x,
/// as in NumPy's arrays, and with 3 or 4 (x*x)*x or (x*x)*(x*x), much quicker than `std::pow` and
/// within 1 or 1.5 units in the last place of the exact power.
class Graph {
 public:
  Node constant(double value);
  Node time();                     ///< [s]
  Node continuous_state(Index i);  ///< at.x[i]
  Node discrete_state(Index i);    ///< at.z[i]
  Node mode();                     ///< at.mode
  Node entry();                    ///< at.entry
  Node parameter(Index i);         ///< at.p[i]
  Node input(int k, Index i);      ///< at.u[k][i]

  /// Any operation; ModelError if it takes another number of operands or one of them is not a node
  /// of this graph.
  Node apply(Op op, std::span<const Node> operands);
  Node unary(Op op, Node a) { return apply(op, std::array{a}); }
  Node binary(Op op, Node a, Node b) { return apply(op, std::array{a, b}); }
  Node select(Node c, Node a, Node b) { return apply(Op::select, std::array{c, a, b}); }

  /// The number, if the node is constant.
  std::optional<double> value(Node node) const;
  /// What a node stands for; ModelError if it is not a node of this graph.
  const Expression& operator[](Node node) const;
  /// Nodes made so far.
  int size() const noexcept { return static_cast<int>(expressions_.size()); }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept;
  };

  Node variable(Op op, Index i, int port = 0);
  Node find_or_add(const Expression& expression);
  std::optional<Node> folded(Op op, std::span<const Node> operands);

  std::vector<Expression> expressions_;
  std::unordered_map<Key, int, Hash> known_;
};

}  // namespace saltus::tape
