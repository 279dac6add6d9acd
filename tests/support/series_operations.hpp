// Every operation that a series knows.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "saltus/tape/graph.hpp"

namespace support {

struct Named {
  std::string name;
  saltus::tape::Node node;
};

/// Every operation of two smooth operands, each between 0 and 1, and its special cases. If `apart`
/// is true, each has operands of its own, which are sums that nothing else reads.
inline std::vector<Named> operations(saltus::tape::Graph& g, saltus::tape::Node x,
                                     saltus::tape::Node y, bool apart = false) {
  using namespace saltus::tape;
  std::vector<Named> all;
  const auto n = [&](double value) { return g.constant(value); };
  const auto add = [&](std::string name, Node node) { all.push_back({std::move(name), node}); };
  const auto binary = [&](Op op, Node a, Node b) { return g.binary(op, a, b); };
  const Node first = x, second = y;
  const auto renew = [&] {  // a little more each time
    const double factor = 1e-3 * static_cast<double>(1 + all.size());
    if (apart) x = binary(Op::add, first, binary(Op::mul, n(factor), second));
    if (apart) y = binary(Op::sub, second, binary(Op::mul, n(factor), first));
  };
  for (int o = static_cast<int>(Op::neg); o < operation_count; ++o) {
    const Op op = static_cast<Op>(o);
    const std::string word(name(op));
    renew();
    const Node inside = op == Op::acosh ? binary(Op::add, n(1.0), x) : x;
    if (operand_count(op) == 1) add(word, g.unary(op, inside));
    if (operand_count(op) == 2) {
      add(word, binary(op, x, y));
      renew();
      add(word + " of itself", binary(op, x, x));
      renew();
      add(word + " with a constant", binary(op, x, n(0.75)));
      add(word + " of a constant", binary(op, n(0.75), y));
      add(word + " with a parameter", binary(op, x, g.parameter(0)));
    }
  }
  add("select", g.select(binary(Op::lt, x, y), g.unary(Op::exp, x), g.unary(Op::sin, y)));
  add("select of numbers", g.select(g.parameter(0), n(1.0), y));
  for (const double p : {5.0, 6.0, 7.0, 16.0, 20.0, -2.0, 1.5, -1.5, 0.3}) {
    renew();
    add("pow " + std::to_string(p), binary(Op::pow, x, n(p)));
  }
  add("tan of sin", g.unary(Op::tan, g.unary(Op::sin, x)));
  add("log of exp", g.unary(Op::log, g.unary(Op::exp, x)));
  add("inverse", binary(Op::div, n(1.0), x));
  return all;
}

inline std::vector<saltus::tape::Node> nodes_of(const std::vector<Named>& all) {
  std::vector<saltus::tape::Node> nodes;
  for (const Named& one : all) nodes.push_back(one.node);
  return nodes;
}

}  // namespace support
