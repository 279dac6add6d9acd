// From expressions to the program of a series.
#include <algorithm>
#include <utility>

#include "../arithmetic.hpp"
#include "../copy.hpp"
#include "lower.hpp"
#include "needs.hpp"
#include "saltus/base/error.hpp"
#include "wide.hpp"

namespace saltus::tape::series {

namespace {

class Builder {
 public:
  Builder(const Graph& graph, std::span<const Node> rates, std::span<const Node> outputs)
      : count_(rates.size()) {
    program_.states = static_cast<int>(count_);
    for (std::size_t i = 0; i < count_; ++i) graph_.continuous_state(static_cast<Index>(i));
    std::vector<Node> all(rates.begin(), rates.end());
    all.insert(all.end(), outputs.begin(), outputs.end());
    nodes_ = copy(graph, all, graph_);
    check_states();
  }

  Program build() {
    Lowering lowering(graph_, program_, nodes_);
    const auto rates = std::span(nodes_).first(count_), outputs = std::span(nodes_).subspan(count_);
    for (const Node node : rates) program_.rates.push_back({node.id, lowering.single(node)});
    program_.first_instructions = static_cast<int>(program_.instructions.size());
    for (const Node node : outputs) {
      program_.outputs.push_back({lowering.row(node), node.id, {}, {}});
    }
    for (Instruction& i : program_.instructions) i.term = program_.terms.data() + i.first_term;
    add_calls();
    add_leaves();
    add_values(rates);
    program_.wide = widen(program_);
    find_needs(program_, graph_, place_);
    return std::move(program_);
  }

 private:
  void check_states() const {
    for (int id = 0; id < graph_.size(); ++id) {
      const Expression& e = graph_[Node{id}];
      if (e.op != Op::continuous_state || e.index < static_cast<Index>(count_)) continue;
      throw ModelError(text("a series of ", count_, " rates expects expressions that read states ",
                            "below ", count_, ", found state ", e.index));
    }
  }

  void add_calls() {
    for (int i = 0; i < program_.first_instructions; ++i) {
      const Instruction& one = program_.instructions[static_cast<std::size_t>(i)];
      program_.calls.append(one.kernel->narrow, one, sums_size * i);
    }
  }

  void add_leaves() {
    program_.constants.assign(static_cast<std::size_t>(graph_.size()), 0.0);
    program_.is_constant.assign(program_.constants.size(), 0);
    for (int id = 0; id < graph_.size(); ++id) {
      const Expression& e = graph_[Node{id}];
      const auto number = static_cast<std::size_t>(id);
      program_.is_constant[number] = e.op == Op::constant ? 1 : 0;
      if (e.op == Op::constant) program_.constants[number] = e.value;
      if (is_variable(e.op) && e.op != Op::continuous_state) {
        program_.loads.push_back({e.op, e.index, e.port, id});
      }
    }
  }

  /// The values that rates and their instructions need come first; then all others.
  void add_values(std::span<const Node> rates) {
    place_.assign(static_cast<std::size_t>(graph_.size()), -1);
    std::vector<Node> roots(rates.begin(), rates.end());
    for (const Rate& rate : program_.rates) roots.push_back({static_cast<int>(rate.term.factor)});
    for (int i = 0; i < program_.first_instructions; ++i) {
      append_values(roots, program_.instructions[static_cast<std::size_t>(i)]);
    }
    auto first = needed(graph_, roots);
    std::ranges::sort(first);  // operands have smaller numbers
    for (const Node node : first) add_value(node);
    program_.first_values = static_cast<int>(program_.values.size());
    for (int id = 0; id < graph_.size(); ++id) add_value({id});
  }

  void add_value(Node node) {
    const Expression& e = graph_[node];
    int& place = place_[static_cast<std::size_t>(node.id)];
    if (operand_count(e.op) == 0 || place >= 0) return;
    place = static_cast<int>(program_.values.size());
    Value value{.run = function(e.op), .to = node.id, .op = e.op};
    for (int k = 0; k < operand_count(e.op); ++k) {
      value.from[k] = e.operands[static_cast<std::size_t>(k)].id;
    }
    program_.values.push_back(value);
  }

  Graph graph_;
  std::size_t count_;
  std::vector<Node> nodes_;
  Program program_;
  std::vector<int> place_;  ///< of the value of a node, or -1
};

template <Op op>
double value_of(double a, double b, double c) {
  return compute(op, a, b, c);
}

}  // namespace

void stop(const Call*, double*, double*, const double*, Index) {}

void Calls::append(Handler handler, const Instruction& instruction, Index own) {
  constexpr std::size_t longest = 256;
  if (handler == nullptr) return;
  if (!all.empty() && all.size() - starts.back() <= longest) {
    all.pop_back();
  } else {
    starts.push_back(all.size());
  }
  all.push_back({handler, &instruction, own});
  all.push_back({&stop, nullptr, 0});
}

void Orders::append(const Handlers& handlers, const Instruction& instruction, Index own) {
  begin.append(handlers.begin, instruction, own);
  earlier.append(handlers.earlier, instruction, own);
  for (std::size_t slot = 1; slot < 8; ++slot) {
    orders[slot].append(handlers.orders[slot], instruction, own);
  }
}

Function function(Op op) {
  static constexpr auto all = []<std::size_t... o>(std::index_sequence<o...>) {
    return std::array<Function, sizeof...(o)>{&value_of<static_cast<Op>(o)>...};
  }(std::make_index_sequence<operation_count>{});
  return all[static_cast<std::size_t>(op)];
}

std::shared_ptr<const Program> build(const Graph& graph, std::span<const Node> rates,
                                     std::span<const Node> outputs) {
  return std::make_shared<const Program>(Builder(graph, rates, outputs).build());
}

}  // namespace saltus::tape::series
