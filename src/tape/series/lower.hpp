// Lowering: the instructions for the rows of expressions.
#pragma once

#include <unordered_map>
#include <vector>

#include "helpers.hpp"
#include "kernels.hpp"

namespace saltus::tape::series {

/// Appends the instructions that expressions need to a program. An operation without a kernel of
/// its own gets helping expressions, which are added to the graph.
class Lowering : Helpers {
 public:
  /// The states have rows already. `roots` are the expressions that will be asked for.
  Lowering(Graph& graph, Program& program, std::span<const Node> roots);

  /// The row of an expression, with the instructions for it and for its operands.
  Index row(Node node);
  /// The row of an expression, or a row of which the expression is a multiple.
  Term single(Node node);

 private:
  /// A sum of multiples of rows, up to a constant.
  using Form = std::vector<Term>;

  void visit(Node node);
  Form form(Node node);
  Form sum_of(Form a, const Form& b);
  Form scaled(Form form, Node factor);
  Index keep(Node node, Form form);
  Index combine(const Form& form);

  Index lower(Node node, const Expression& e);
  Index lower_varying(Node node, const Expression& e);
  Index lower_kinked(Node node, const Expression& e);
  Index lower_unary(Node node, const Expression& e);
  Index lower_product(Node node, Node a, Node b);
  Index lower_quotient(Node node, Node a, Node b);
  Index lower_power(Node node, Node a, Node b);
  Index lower_whole_power(Node a, int exponent);
  Index lower_angle(Node a, Node b);
  Index lower_choice(const Expression& e);
  Index lower_rotation(Node node, Op sine, Op cosine, Node a, double factor);
  Index lower_growth(Node node, Node a, double factor, Node b);
  Index lower_logarithm(Node a, double factor, Node b);

  Index new_row() { return row_size * program_.rows++; }
  Index slope(Index row);
  Index add(const Kernel& kernel, Instruction i);
  Index& known(Node node);

  static Node node(Index value) { return {static_cast<int>(value)}; }

  Program& program_;
  static constexpr Index unknown = -1, linear = -2;
  std::vector<Index>
      rows_;  ///< the row of each node, or its state: `linear` means a form without a row
  std::unordered_map<int, Form> forms_;
  std::vector<int> uses_;  ///< of each node of the original graph
  std::vector<Index>
      slopes_;  ///< for each row: the row of k times its coefficient of order k, or -1
};

}  // namespace saltus::tape::series
