// Linear expressions: sums of multiples, which one instruction computes.
#include <algorithm>

#include "lower.hpp"

namespace saltus::tape::series {

/// An expression with several readers gets a row, unless it is a multiple of one; so does a long
/// sum, which would be copied again and again.
Lowering::Form Lowering::form(Node node) {
  constexpr std::size_t longest = 16;
  visit(node);
  if (known(node) == zero_row) return {};
  if (known(node) == linear) {
    const Form& found = forms_[node.id];
    const auto id = static_cast<std::size_t>(node.id);
    const bool once = id < uses_.size() && uses_[id] < 2;
    if (found.size() == 1 || (once && found.size() <= longest)) return found;
  }
  return {{row(node), n(1.0).id}};
}

Term Lowering::single(Node node) {
  visit(node);
  if (known(node) == linear && forms_[node.id].size() == 1) return forms_[node.id][0];
  return {row(node), n(1.0).id};
}

Lowering::Form Lowering::sum_of(Form a, const Form& b) {
  for (const Term& term : b) {
    const auto found = std::ranges::find(a, term.row, &Term::row);
    if (found == a.end()) {
      a.push_back(term);
    } else {
      found->factor = of(Op::add, node(found->factor), node(term.factor)).id;
    }
  }
  std::erase_if(a, [this](const Term& term) { return graph_.value(node(term.factor)) == 0.0; });
  return a;
}

Lowering::Form Lowering::scaled(Form form, Node factor) {
  for (Term& term : form) term.factor = times(node(term.factor), factor).id;
  return form;
}

/// The row of a form that is one; otherwise the form is kept until its row is needed.
Index Lowering::keep(Node node, Form form) {
  if (form.empty()) return zero_row;
  if (form.size() == 1 && form[0].factor == n(1.0).id) return form[0].row;
  forms_[node.id] = std::move(form);
  return linear;
}

Index Lowering::combine(const Form& form) {
  const auto is = [&](std::size_t i, double factor) { return form[i].factor == n(factor).id; };
  if (form.size() == 1) return add(multiple, {.a = form[0].row, .of_b = form[0].factor});
  if (form.size() == 2 && is(0, 1.0) && is(1, 1.0)) {
    return add(plus, {.a = form[0].row, .b = form[1].row});
  }
  if (form.size() == 2 && is(0, 1.0) && is(1, -1.0)) {
    return add(minus, {.a = form[0].row, .b = form[1].row});
  }
  const auto first = static_cast<Index>(program_.terms.size());
  program_.terms.insert(program_.terms.end(), form.begin(), form.end());
  return add(combination, {.first_term = first, .terms = static_cast<Index>(form.size())});
}

}  // namespace saltus::tape::series
