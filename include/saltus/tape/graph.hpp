// Graph: expressions over the time, states, parameters and inputs of a block. Equal expressions are
// one node.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"
#include "saltus/tape/operation.hpp"

namespace saltus::tape {

/// Identifies one expression of a graph. Operands have smaller numbers than the expression that
/// uses them.
struct Node {
  int id = -1;
  auto operator<=>(const Node&) const = default;
};

/// The definition of a node.
struct Expression {
  Op op = Op::constant;
  std::array<Node, 3> operands = {};  ///< as many as `operand_count(op)`
  double value = 0.0;                 ///< of a constant
  Index index = 0;                    ///< of a variable: the number of its entry
  int port = 0;                       ///< of an input: the number of its port
};

/// Expressions, built from small to large.
///
/// A second request for the same expression gives the same node; for `add`, `mul` and the like the
/// order of the operands does not matter. An expression of constants is computed at once, by the
/// functions that a tape runs. Apart from that, an expression is made shorter only by identities
/// that hold to the last bit, including signs of zeros and NaN: x*1, x - 0, -(-x), x/2 = x*0.5,
/// select of a constant. `gt` and `ge` become `lt` and `le` with their operands exchanged.
///
/// One rule changes bits: `pow` with the constant exponent 2, 0.5 or -1 becomes x*x, sqrt(x), 1/x,
/// as in NumPy's arrays. With 3 or 4 it becomes (x*x)*x or (x*x)*(x*x), which is much quicker than
/// `std::pow` and within 1 or 1.5 units in the last place of the exact power. It stays `pow`, but
/// is computed as x*sqrt(x), (x*x)*sqrt(x), 1/sqrt(x), 1/(x*sqrt(x)), 1/(x*x), 1/((x*x)*x), for the
/// exponents 1.5, 2.5, -0.5, -1.5, -2, -3: two or three roundings, where x*x is a normal number;
/// NaN for x = -Inf with a half exponent.
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

  /// Any operation; ModelError if it takes another number of operands or an operand is not a node
  /// of this graph.
  Node apply(Op op, std::span<const Node> operands);
  Node unary(Op op, Node a) { return apply(op, std::array{a}); }
  Node binary(Op op, Node a, Node b) { return apply(op, std::array{a, b}); }
  Node select(Node c, Node a, Node b) { return apply(Op::select, std::array{c, a, b}); }

  /// The number, if the node is constant.
  std::optional<double> value(Node node) const;
  /// The definition of a node; ModelError if it is not a node of this graph.
  const Expression& operator[](Node node) const;
  /// The number of nodes.
  int size() const noexcept { return static_cast<int>(expressions_.size()); }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept;
  };

  Node variable(Op op, Index i, int port = 0);
  Node find_or_add(const Expression& expression);
  std::optional<Node> folded(Op op, std::span<const Node> operands);

  List<Expression> expressions_;
  std::unordered_map<Key, int, Hash> known_;
};

}  // namespace saltus::tape
