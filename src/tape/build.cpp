// From expressions to instructions: which array each number is in, and for how long.
#include <algorithm>

#include "copy.hpp"
#include "program.hpp"

namespace saltus::tape::detail {

namespace {

constexpr bool is_computed(Op op) { return op > Op::input; }

class Builder {
 public:
  Builder(const Graph& graph, std::span<const Node> outputs) {
    program_.outputs = copy(graph, outputs, program_.graph);
    places_.resize(static_cast<std::size_t>(program_.graph.size()));
    uses_.resize(places_.size());
  }

  Program build() {
    const auto order = needed(program_.graph, program_.outputs);
    count_uses(order);
    place_outputs();
    for (const Node node : order) place_and_compute(node);
    copy_outputs();
    return std::move(program_);
  }

 private:
  struct Use {
    int left = 0;     ///< operations still to come that read the node
    int output = -1;  ///< which output it is computed into
  };

  const Expression& at(Node node) const { return program_.graph[node]; }
  Address& place(Node node) { return places_[static_cast<std::size_t>(node.id)]; }
  Use& use(Node node) { return uses_[static_cast<std::size_t>(node.id)]; }
  std::span<const Node> operands(const Expression& e) const {
    return {e.operands.data(), static_cast<std::size_t>(operand_count(e.op))};
  }

  void count_uses(const std::vector<Node>& order) {
    for (const Node node : order) {
      for (const Node operand : operands(at(node))) ++use(operand).left;
    }
  }

  /// A computed node goes straight to the first output that shows it.
  void place_outputs() {
    for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
      const Node node = program_.outputs[i];
      if (is_computed(at(node).op) && use(node).output < 0) {
        use(node).output = static_cast<int>(i);
        place(node) = {out, static_cast<std::uint32_t>(i)};
      }
    }
  }

  void place_and_compute(Node node) {
    const Expression& e = at(node);
    if (!is_computed(e.op)) {
      place(node) = e.op == Op::constant ? constant(e.value) : variable(e);
      return;
    }
    Instruction instruction{.run = handler(e.op), .op = e.op};
    std::size_t i = 0;
    for (const Node operand : operands(e)) {
      instruction.from[i++] = place(operand);
      if (--use(operand).left == 0 && place(operand).base == registers) {
        free_.push_back(place(operand).offset);
      }
    }
    if (use(node).output < 0) place(node) = {registers, take_register()};
    instruction.to = place(node);
    program_.instructions.push_back(instruction);
  }

  /// Outputs that are variables or constants, or that are there twice.
  void copy_outputs() {
    for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
      const Node node = program_.outputs[i];
      if (use(node).output == static_cast<int>(i)) continue;
      program_.instructions.push_back({.run = handler(Op::constant),
                                       .to = {out, static_cast<std::uint32_t>(i)},
                                       .from = {place(node)}});
    }
  }

  std::uint32_t take_register() {
    if (free_.empty()) return static_cast<std::uint32_t>(program_.registers++);
    const std::uint32_t taken = free_.back();
    free_.pop_back();
    return taken;
  }

  Address constant(double value) {
    program_.constants.push_back(value);
    return {constants, static_cast<std::uint32_t>(program_.constants.size() - 1)};
  }

  Address variable(const Expression& e) {
    const auto i = static_cast<std::uint32_t>(e.index);
    const auto entry_of = [&](Base base, Index& size, Reads reads) -> Address {
      size = std::max(size, e.index + 1);
      program_.reads = program_.reads | reads;
      return {base, i};
    };
    Index none = 0;
    switch (e.op) {
      case Op::time:
        entry_of(scalars, none, Reads::time);
        return {scalars, time};
      case Op::mode:
        entry_of(scalars, none, Reads::mode);
        return {scalars, mode};
      case Op::entry:
        program_.reads_entry = true;
        return {scalars, entry};
      case Op::continuous_state:
        return entry_of(x, program_.x, Reads::continuous_state);
      case Op::discrete_state:
        return entry_of(z, program_.z, Reads::discrete_state);
      case Op::parameter:
        return entry_of(p, program_.p, Reads::parameters);
      default:
        return input(e);
    }
  }

  Address input(const Expression& e) {
    program_.reads = program_.reads | Reads::inputs;
    auto found = std::ranges::find(program_.inputs, e.port);
    const auto which = static_cast<std::size_t>(found - program_.inputs.begin());
    if (found == program_.inputs.end()) {
      program_.inputs.push_back(e.port);
      program_.widths.push_back(0);
    }
    program_.widths[which] = std::max(program_.widths[which], e.index + 1);
    return {inputs + static_cast<std::uint32_t>(which), static_cast<std::uint32_t>(e.index)};
  }

  Program program_;
  std::vector<Address> places_;
  std::vector<Use> uses_;
  std::vector<std::uint32_t> free_;
};

}  // namespace

Program build(const Graph& graph, std::span<const Node> outputs) {
  return Builder(graph, outputs).build();
}

}  // namespace saltus::tape::detail
