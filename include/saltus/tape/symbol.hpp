// Symbol: a node of a graph, with the operations of a number.
#pragma once

#include <initializer_list>

#include "saltus/tape/graph.hpp"

namespace saltus::tape {

/// A number known only by its formula: a node of a graph, or a constant that is not yet in a graph.
/// A function template that is called with symbols in place of doubles builds the graph of its
/// computation, operation by operation and in the same order. So the tape of that graph gives the
/// same numbers to the last bit. Comparisons give symbols too, 0 or 1, so a symbol cannot decide an
/// `if`. There is no `pow`, because a graph replaces some powers by products, which differ from
/// `std::pow` in the last bit.
class Symbol {
 public:
  Symbol(double value = 0.0) : value_(value) {}  // NOLINT(google-explicit-constructor): a number
  Symbol(Graph& graph, Node node) : graph_(&graph), node_(node) {}

  /// The node in `graph`, which must be the graph of its variables.
  Node in(Graph& graph) const { return graph_ == nullptr ? graph.constant(value_) : node_; }

  friend Symbol operator+(const Symbol& a, const Symbol& b) { return apply(Op::add, {a, b}); }
  friend Symbol operator-(const Symbol& a, const Symbol& b) { return apply(Op::sub, {a, b}); }
  friend Symbol operator*(const Symbol& a, const Symbol& b) { return apply(Op::mul, {a, b}); }
  friend Symbol operator/(const Symbol& a, const Symbol& b) { return apply(Op::div, {a, b}); }
  friend Symbol operator-(const Symbol& a) { return apply(Op::neg, {a}); }
  Symbol& operator+=(const Symbol& b) { return *this = *this + b; }
  Symbol& operator-=(const Symbol& b) { return *this = *this - b; }
  Symbol& operator*=(const Symbol& b) { return *this = *this * b; }
  Symbol& operator/=(const Symbol& b) { return *this = *this / b; }

  friend Symbol operator<(const Symbol& a, const Symbol& b) { return apply(Op::lt, {a, b}); }
  friend Symbol operator<=(const Symbol& a, const Symbol& b) { return apply(Op::le, {a, b}); }
  friend Symbol operator>(const Symbol& a, const Symbol& b) { return apply(Op::gt, {a, b}); }
  friend Symbol operator>=(const Symbol& a, const Symbol& b) { return apply(Op::ge, {a, b}); }
  friend Symbol operator==(const Symbol& a, const Symbol& b) { return apply(Op::eq, {a, b}); }
  friend Symbol operator!=(const Symbol& a, const Symbol& b) { return apply(Op::ne, {a, b}); }

  // The functions of <cmath>. With `using std::sin;` a call sin(u) works for numbers too.
  friend Symbol abs(const Symbol& a) { return apply(Op::abs, {a}); }
  friend Symbol sqrt(const Symbol& a) { return apply(Op::sqrt, {a}); }
  friend Symbol cbrt(const Symbol& a) { return apply(Op::cbrt, {a}); }
  friend Symbol exp(const Symbol& a) { return apply(Op::exp, {a}); }
  friend Symbol expm1(const Symbol& a) { return apply(Op::expm1, {a}); }
  friend Symbol log(const Symbol& a) { return apply(Op::log, {a}); }
  friend Symbol log10(const Symbol& a) { return apply(Op::log10, {a}); }
  friend Symbol log1p(const Symbol& a) { return apply(Op::log1p, {a}); }
  friend Symbol sin(const Symbol& a) { return apply(Op::sin, {a}); }
  friend Symbol cos(const Symbol& a) { return apply(Op::cos, {a}); }
  friend Symbol tan(const Symbol& a) { return apply(Op::tan, {a}); }
  friend Symbol asin(const Symbol& a) { return apply(Op::asin, {a}); }
  friend Symbol acos(const Symbol& a) { return apply(Op::acos, {a}); }
  friend Symbol atan(const Symbol& a) { return apply(Op::atan, {a}); }
  friend Symbol atan2(const Symbol& a, const Symbol& b) { return apply(Op::atan2, {a, b}); }
  friend Symbol hypot(const Symbol& a, const Symbol& b) { return apply(Op::hypot, {a, b}); }
  friend Symbol sinh(const Symbol& a) { return apply(Op::sinh, {a}); }
  friend Symbol cosh(const Symbol& a) { return apply(Op::cosh, {a}); }
  friend Symbol tanh(const Symbol& a) { return apply(Op::tanh, {a}); }

  /// Any operation of a graph; ModelError if it takes another number of operands.
  static Symbol apply(Op op, std::initializer_list<Symbol> operands);

 private:
  Graph* graph_ = nullptr;  ///< null: a constant
  Node node_ = {};
  double value_ = 0.0;
};

}  // namespace saltus::tape
