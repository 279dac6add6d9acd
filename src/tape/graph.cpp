#include "saltus/tape/graph.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "arithmetic.hpp"
#include "saltus/base/error.hpp"
#include "simplify.hpp"

namespace saltus::tape {

std::size_t Graph::Hash::operator()(const Key& key) const noexcept {
  std::uint64_t mixed = 0;
  for (const std::uint64_t part : key) {  // the finalizer of MurmurHash3
    mixed ^= part;
    mixed = (mixed ^ mixed >> 33U) * 0xFF51AFD7ED558CCDU;
    mixed = (mixed ^ mixed >> 33U) * 0xC4CEB9FE1A85EC53U;
    mixed ^= mixed >> 33U;
  }
  return static_cast<std::size_t>(mixed);
}

Node Graph::find_or_add(const Expression& e) {
  const auto word = [](int high, int low) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32U |
           static_cast<std::uint32_t>(low);
  };
  const std::uint64_t last = operand_count(e.op) > 0 ? word(e.operands[1].id, e.operands[2].id)
                             : e.op == Op::constant  ? std::bit_cast<std::uint64_t>(e.value)
                                                     : static_cast<std::uint64_t>(e.index);
  const Key key{static_cast<std::uint64_t>(e.op), word(e.port, e.operands[0].id), last};
  if (size() == std::numeric_limits<int>::max()) throw ModelError("the expression is too large");
  const auto [known, is_new] = known_.try_emplace(key, size());
  if (is_new) expressions_.push_back(e);
  return {known->second};
}

Node Graph::constant(double value) { return find_or_add({.value = value}); }

Node Graph::variable(Op op, Index i, int port) {
  if (i < 0 || port < 0 || i > std::numeric_limits<int>::max()) {
    throw ModelError(text("expected the number of an entry of ", name(op), " from 0 to ",
                          std::numeric_limits<int>::max(), ", found ", port < 0 ? port : i));
  }
  return find_or_add({.op = op, .index = i, .port = port});
}

Node Graph::time() { return variable(Op::time, 0); }
Node Graph::continuous_state(Index i) { return variable(Op::continuous_state, i); }
Node Graph::discrete_state(Index i) { return variable(Op::discrete_state, i); }
Node Graph::mode() { return variable(Op::mode, 0); }
Node Graph::entry() { return variable(Op::entry, 0); }
Node Graph::parameter(Index i) { return variable(Op::parameter, i); }
Node Graph::input(int k, Index i) { return variable(Op::input, i, k); }

const Expression& Graph::operator[](Node node) const {
  if (node.id < 0 || node.id >= size()) {
    throw ModelError(text("there is no node ", node.id, " in this graph of ", size(), " nodes"));
  }
  return expressions_[node.id];
}

std::optional<double> Graph::value(Node node) const {
  const Expression& e = (*this)[node];
  return e.op == Op::constant ? std::optional(e.value) : std::nullopt;
}

std::optional<Node> Graph::folded(Op op, std::span<const Node> operands) {
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const auto number = value(operands[i]);
    if (!number) return {};
    numbers[i] = *number;
  }
  return constant(compute(op, numbers[0], numbers[1], numbers[2]));
}

Node Graph::apply(Op op, std::span<const Node> operands) {
  const int expected = operand_count(op);
  if (expected == 0 || static_cast<std::size_t>(expected) != operands.size()) {
    throw ModelError(
        text("operation '", name(op), "' takes ", expected, " nodes, found ", operands.size()));
  }
  for (const Node operand : operands) (void)(*this)[operand];  // each must exist
  if (const auto number = folded(op, operands)) return *number;
  if (const auto simpler = simplified(*this, op, operands)) return *simpler;
  Expression e{.op = op};
  std::ranges::copy(operands, e.operands.begin());
  if (is_commutative(op) && e.operands[1] < e.operands[0]) std::swap(e.operands[0], e.operands[1]);
  return find_or_add(e);
}

}  // namespace saltus::tape
