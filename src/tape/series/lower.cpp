#include "lower.hpp"

namespace saltus::tape::series {

namespace {

/// Whether an operation of one operand has a derivative everywhere: those before `floor`.
bool is_smooth_unary(Op op) { return operand_count(op) == 1 && op < Op::floor && op != Op::abs; }

}  // namespace

Lowering::Lowering(Graph& graph, Program& program, std::span<const Node> roots)
    : Helpers(graph), program_(program) {
  program_.rows = 1 + program_.states;  // the row of zeros, the states
  uses_.assign(static_cast<std::size_t>(graph_.size()), 0);
  for (const Node wanted : roots) ++uses_[static_cast<std::size_t>(wanted.id)];
  for (int id = 0; id < graph_.size(); ++id) {
    const Expression& e = graph_[Node{id}];
    for (int k = 0; k < operand_count(e.op); ++k) {
      ++uses_[static_cast<std::size_t>(e.operands[static_cast<std::size_t>(k)].id)];
    }
  }
}

Index& Lowering::known(Node node) {
  if (rows_.size() < static_cast<std::size_t>(graph_.size())) {
    rows_.resize(static_cast<std::size_t>(graph_.size()), -1);
  }
  return rows_[static_cast<std::size_t>(node.id)];
}

void Lowering::visit(Node wanted) {
  std::vector<Node> open{wanted};  // depth first, without recursion: expressions may be deep
  while (!open.empty()) {
    const Node node = open.back();
    const Expression e = graph_[node];  // a copy: the graph grows
    const std::size_t size = open.size();
    for (int k = operand_count(e.op) - 1; k >= 0 && known(node) == unknown; --k) {
      const Node operand = e.operands[static_cast<std::size_t>(k)];
      if (known(operand) == unknown) open.push_back(operand);
    }
    if (open.size() > size) continue;
    open.pop_back();
    if (known(node) != unknown) continue;
    const Index found = lower(node, e);
    known(node) = found;
  }
}

Index Lowering::row(Node node) {
  visit(node);
  if (known(node) == linear) {
    const Index found = combine(forms_[node.id]);
    known(node) = found;
  }
  return known(node);
}

Index Lowering::add(const Kernel& kernel, Instruction i) {
  i.kernel = &kernel;
  if (i.to == zero_row) i.to = new_row();
  program_.instructions.push_back(i);
  return i.to;
}

Index Lowering::slope(Index row) {
  const auto number = static_cast<std::size_t>(row / row_size);
  if (slopes_.size() <= number) slopes_.resize(number + 1, -1);
  if (slopes_[number] < 0) slopes_[number] = new_row();
  return slopes_[number];
}

Index Lowering::lower(Node node, const Expression& e) {
  if (e.op == Op::continuous_state) return row_size * (1 + e.index);
  if (e.op == Op::time) return program_.time_row = new_row();
  bool varies = false;
  for (int k = 0; k < operand_count(e.op); ++k) {
    varies = varies || known(e.operands[static_cast<std::size_t>(k)]) != zero_row;
  }
  return varies ? lower_varying(node, e) : zero_row;
}

Index Lowering::lower_varying(Node node, const Expression& e) {
  const auto [a, b, c] = e.operands;
  switch (e.op) {
    case Op::add:
    case Op::sub:
      return keep(node, sum_of(form(a), e.op == Op::add ? form(b) : scaled(form(b), n(-1.0))));
    case Op::mul:
      return lower_product(node, a, b);
    case Op::div:
      return lower_quotient(node, a, b);
    case Op::pow:
      return lower_power(node, a, b);
    case Op::atan2:
      return lower_angle(a, b);
    case Op::hypot:
      return add(root, {.a = row(sum_of_squares(a, b)), .value = node.id});
    default:
      return is_smooth_unary(e.op) ? lower_unary(node, e) : lower_kinked(node, e);
  }
}

Index Lowering::lower_product(Node node, Node a, Node b) {
  if (known(a) == zero_row) std::swap(a, b);
  if (known(b) == zero_row) return keep(node, scaled(form(a), b));
  if (a == b) return add(square, {.a = row(a), .of_a = a.id});
  if (row(b) < row(a)) std::swap(a, b);  // a row with a higher number is computed later
  return add(product, {.a = row(a), .b = row(b), .of_a = a.id, .of_b = b.id});
}

Index Lowering::lower_quotient(Node node, Node a, Node b) {
  if (known(b) == zero_row) return keep(node, scaled(form(a), of(Op::div, n(1.0), b)));
  const Term above = single(a);
  return add(quotient,
             {.a = above.row, .b = row(b), .value = node.id, .of_a = above.factor, .of_b = b.id});
}

Index Lowering::lower_kinked(Node node, const Expression& e) {
  const Node a = e.operands[0], b = e.operands[1];
  switch (e.op) {
    case Op::abs:
      return add(magnitude, {.a = row(a), .of_a = a.id, .op = e.op});
    case Op::copysign:
      if (known(a) == zero_row) return zero_row;
      return add(magnitude, {.a = row(a), .of_a = a.id, .of_b = b.id, .op = e.op});
    case Op::minimum:
    case Op::maximum:
      return add(extreme, {.a = row(a),
                           .b = row(b),
                           .of_a = a.id,
                           .of_b = b.id,
                           .factor = e.op == Op::minimum ? 1.0 : -1.0});
    case Op::mod:
    case Op::fmod:
      return add(remainder,
                 {.a = row(a), .b = row(b), .value = node.id, .of_a = a.id, .of_b = b.id});
    case Op::select:
      return lower_choice(e);
    default:
      return zero_row;  // a step
  }
}

Index Lowering::lower_choice(const Expression& e) {
  const auto [condition, a, b] = e.operands;
  if (known(a) == zero_row && known(b) == zero_row) return zero_row;
  Instruction i{.a = row(a), .b = row(b), .of_a = a.id, .of_b = b.id, .of_c = condition.id};
  const Expression compared = graph_[condition];
  if (compared.op >= Op::lt && compared.op <= Op::ne) {
    const auto [c, d, none] = compared.operands;
    i.op = compared.op, i.c = row(c), i.d = known(d), i.of_c = c.id, i.of_d = d.id;
  }
  return add(choice, i);
}

}  // namespace saltus::tape::series
