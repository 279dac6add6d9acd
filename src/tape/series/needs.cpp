#include "needs.hpp"

#include <algorithm>
#include <utility>

namespace saltus::tape::series {

namespace {

std::span<const Term> terms_of(const Instruction& i) {
  return {i.term, static_cast<std::size_t>(i.terms)};
}

class NeedSearch {
 public:
  NeedSearch(Program& program, const Graph& graph, const std::vector<int>& places)
      : program_(program), graph_(graph), places_(places) {
    writers_.assign(static_cast<std::size_t>(program.rows), -1);
    seen_.assign(program.instructions.size(), -1);
    valued_.assign(static_cast<std::size_t>(graph.size()), -1);
    for (std::size_t n = 0; n < program.instructions.size(); ++n) {
      const Instruction& i = program.instructions[n];
      writer(i.to) = static_cast<int>(n);
      if (i.to_second != zero_row) writer(i.to_second) = static_cast<int>(n);
    }
  }

  void run() {
    for (Output& output : program_.outputs) {
      nodes_ = {{static_cast<int>(output.value)}};
      find_instructions(output);
      find_values(output);
      ++number_;
    }
  }

 private:
  int& writer(Index row) { return writers_[static_cast<std::size_t>(row / row_size)]; }

  /// Follows the rows that instructions read.
  void find_instructions(Output& output) {
    std::vector<Index> open{output.row};
    while (!open.empty()) {
      const int found = writer(open.back());
      open.pop_back();
      if (found < 0) continue;
      const auto n = static_cast<std::size_t>(found);
      if (std::exchange(seen_[n], number_) == number_) continue;
      output.instructions.push_back(found);
      const Instruction& i = program_.instructions[n];
      append_values(nodes_, i);
      for (const Index read : {i.a, i.b, i.c, i.d}) open.push_back(read);
      for (const Term& term : terms_of(i)) open.push_back(term.row);
    }
    std::ranges::sort(output.instructions);
  }

  /// The values that the rates do not need.
  void find_values(Output& output) {
    while (!nodes_.empty()) {
      const Node node = nodes_.back();
      const auto id = static_cast<std::size_t>(node.id);
      nodes_.pop_back();
      if (std::exchange(valued_[id], number_) == number_) continue;
      if (places_[id] >= program_.first_values) output.values.push_back(places_[id]);
      const Expression& e = graph_[node];
      nodes_.insert(nodes_.end(), e.operands.begin(), e.operands.begin() + operand_count(e.op));
    }
    std::ranges::sort(output.values);
  }

  Program& program_;
  const Graph& graph_;
  const std::vector<int>& places_;
  std::vector<int> writers_;  ///< of each row, or -1
  std::vector<int> seen_;     ///< the last output that needs an instruction
  std::vector<int> valued_;   ///< the last output that needs the value of a node
  std::vector<Node> nodes_;   ///< whose values are needed
  int number_ = 0;            ///< of the output
};

}  // namespace

void append_values(std::vector<Node>& nodes, const Instruction& i) {
  const auto append = [&](Index value) { nodes.push_back({static_cast<int>(value)}); };
  for (const Index value : {i.value, i.of_a, i.of_b, i.of_c, i.of_d}) append(value);
  for (const Term& term : terms_of(i)) append(term.factor);
}

void find_needs(Program& program, const Graph& graph, const std::vector<int>& places) {
  NeedSearch(program, graph, places).run();
}

}  // namespace saltus::tape::series
