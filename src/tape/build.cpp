// From expressions to instructions: the place of each number, and how long it keeps that place.
#include <algorithm>
#include <optional>
#include <utility>

#include "arrange.hpp"
#include "copy.hpp"
#include "value.hpp"
#include "variables.hpp"

namespace saltus::tape::detail {

namespace {

class Builder {
 public:
  Builder(Program& program, const Graph& graph, std::span<const Node> outputs,
          std::span<const Index> places)
      : program_(program), places_(places), registers_(program.registers) {
    program_.outputs = copy(graph, outputs, program_.graph);
    values_.resize(program_.graph.size());
  }

  void build() {
    arrangement_ = arrange(program_.graph, program_.outputs);
    note_arrays();
    const std::vector<Group>& groups = arrangement_.groups;
    for (const Group& group : groups) {
      for (const Node node : group) {
        for (const Node operand : operands(node)) ++of(operand).uses;
      }
    }
    for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
      of(program_.outputs[i]).outputs.push_back(place_of_output(i));
    }
    for (int id = 0; id < program_.graph.size(); ++id) {
      if (operand_count(at(Node{id}).op) == 0)
        of(Node{id}).place = place_of_variable(program_, at(Node{id}));
    }
    for (const Group& group : groups) group.size() == 1 ? one(group[0]) : many(group);
    copy_variables();
  }

 private:
  std::uint32_t place_of_output(std::size_t i) const {
    return static_cast<std::uint32_t>(places_.empty() ? static_cast<Index>(i) : places_[i]);
  }
  Value& of(Node node) { return values_[node.id]; }
  const Expression& at(Node node) const { return program_.graph[node]; }
  std::vector<Node> operands(Node node) const {
    const Expression& e = at(node);
    std::vector<Node> all(e.operands.begin(), e.operands.begin() + operand_count(e.op));
    if (arrangement_.swapped[node.id]) std::swap(all[0], all[1]);
    return all;
  }
  void note_arrays() {
    for (std::size_t a = 0; a < arrangement_.arrays.size(); ++a)
      for (const Node node : arrangement_.arrays[a]) of(node).array = static_cast<int>(a);
  }

  /// Registers for adjacent values. The first values of an array bring registers for all of it.
  Place registers_for(std::span<const Node> nodes) {
    Value& first = of(nodes[0]);
    if (first.block < 0) {
      if (first.array < 0) return registers_.take(nodes, values_);
      registers_.take(arrangement_.arrays[first.array], values_);
    }
    Place place = first.place;
    place.stride = nodes.size() > 1 ? 1 : 0;
    return place;
  }

  // --- one number ---

  void one(Node node) {
    const Op op = at(node).op;
    Line line{.op = op};
    const auto all = operands(node);
    for (const Node operand : all) load_if_needed(op, operand);
    for (std::size_t k = 0; k < all.size(); ++k) line.from[k] = place_for(op, all[k]);
    for (const Node operand : all) release(operand);
    Value& value = of(node);
    const bool straight = value.uses == 0;  // directly to the first output that returns it
    line.to = straight ? Place{Kind::out, value.outputs.at(0)} : registers_for({&node, 1});
    add(line, node);
    for (std::size_t i = straight ? 1 : 0; i < value.outputs.size(); ++i) {
      program_.lines.push_back(
          {.to = {Kind::out, value.outputs[i]}, .from = {Place{Kind::before}}});
    }
  }

  /// The place from which an operand is read: the value just computed, if it is the operand.
  Place place_for(Op op, Node node) {
    if (takes_any(op) && node == before_) return {Kind::before};
    return fits(op, of(node).place) ? of(node).place : *of(node).loaded;
  }
  static bool fits(Op op, const Place& place) {
    return takes_any(op) ? place.kind <= Kind::p : place.kind == Kind::reg;
  }

  /// Loads an operand into a register if the operation cannot read it in place. It remains there.
  void load_if_needed(Op op, Node node) {
    if (!fits(op, of(node).place)) load(node);
  }
  void load(Node node) {
    if (of(node).loaded) return;
    const Place to = registers_.keep();
    of(node).loaded = to;
    add({.to = to, .from = {of(node).place}}, node);
  }

  void add(const Line& line, Node node) {
    program_.lines.push_back(line);
    before_ = node;
  }

  // --- many numbers ---

  /// Where a run reads an operand; `next` is the operand of its second value.
  Place operand_of_run(Node first, Node next) {
    const Kind kind = of(first).place.kind;
    const bool alone = kind == Kind::time || kind == Kind::mode || kind == Kind::entry;
    if (alone) load(first);
    Place from = alone ? *of(first).loaded : of(first).place;
    from.stride = first == next ? 0 : distance(of(first).place.offset, of(next).place.offset);
    return from;
  }

  void many(const Group& group) {
    Line line{.op = at(group[0]).op, .count = group.size()};
    const auto first = operands(group[0]), second = operands(group[1]);
    for (std::size_t k = 0; k < first.size(); ++k)
      line.from[k] = operand_of_run(first[k], second[k]);
    // Nothing is released before the run has its place: a run must not write where it reads.
    const auto output = outputs_of(group);
    const bool unread =
        std::ranges::all_of(group, [this](Node node) { return of(node).uses == 0; });
    line.to = output && unread ? *output : registers_for(group);
    for (const Node node : group) {
      for (const Node operand : operands(node)) release(operand);
    }
    add(line, Node{});
    if (output && unread) return;
    copy_out(group);
  }

  /// The outputs of a run, if each of its values has one and they are at equal distances.
  std::optional<Place> outputs_of(std::span<const Node> nodes) {
    for (const Node node : nodes) {
      if (of(node).outputs.size() != 1) return {};
    }
    const std::uint32_t first = of(nodes[0]).outputs[0];
    const std::int32_t stride = distance(first, of(nodes[1]).outputs[0]);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      if (distance(of(nodes[i - 1]).outputs[0], of(nodes[i]).outputs[0]) != stride) return {};
    }
    return Place{Kind::out, first, stride};
  }

  /// Copies a run to its outputs: first the first output of each value, then the second, in pieces
  /// at equal distances.
  void copy_out(std::span<const Node> nodes) {
    std::size_t most = 0;
    for (const Node node : nodes) most = std::max(most, of(node).outputs.size());
    for (std::size_t rank = 0; rank < most; ++rank) {
      for (std::size_t i = 0; i < nodes.size();) i += copy_piece(nodes.subspan(i), rank);
    }
  }
  /// Copies the longest piece that begins with the first node; returns the number of its nodes.
  std::size_t copy_piece(std::span<const Node> nodes, std::size_t rank) {
    const auto has = [&](std::size_t i) { return of(nodes[i]).outputs.size() > rank; };
    const auto output = [&](std::size_t i) { return of(nodes[i]).outputs[rank]; };
    if (!has(0)) return 1;
    Line line{.to = {Kind::out, output(0)}, .from = {of(nodes[0]).place}};
    if (nodes.size() > 1 && has(1)) line.to.stride = distance(output(0), output(1));
    std::size_t count = 1;
    while (count < nodes.size() && has(count) &&
           distance(output(count - 1), output(count)) == line.to.stride) {
      ++count;
    }
    line.count = count < shortest_run ? 1 : count;
    if (line.count > 1) line.from[0].stride = 1;  // the registers of a run are adjacent
    program_.lines.push_back(line);
    return line.count;
  }

  void release(Node node) {
    --of(node).uses;
    registers_.release(of(node).block);
  }

  // --- outputs that are variables or constants ---

  void copy_variables() {
    std::vector<std::pair<std::uint32_t, Node>> all;
    for (std::size_t i = 0; i < program_.outputs.size(); ++i) {
      const Node node = program_.outputs[i];
      if (operand_count(at(node).op) == 0) all.push_back({place_of_output(i), node});
    }
    for (std::size_t i = 0; i < all.size();) {
      const std::size_t count = side_by_side(std::span(all).subspan(i));
      Place to{Kind::out, all[i].first}, from = of(all[i].second).place;
      if (count > 1) {
        to.stride = 1;
        from.stride = distance(from.offset, of(all[i + 1].second).place.offset);
      }
      program_.lines.push_back({.to = to, .from = {from}, .count = count});
      i += count;
    }
  }

  /// The number of outputs, from the first on, that one copy can write.
  std::size_t side_by_side(std::span<const std::pair<std::uint32_t, Node>> all) {
    const Place first = of(all[0].second).place;
    const bool array = first.kind == Kind::x || first.kind == Kind::p || first.kind == Kind::z ||
                       first.kind == Kind::input;
    if (!array || all.size() < shortest_run) return 1;
    const std::int32_t stride = distance(first.offset, of(all[1].second).place.offset);
    std::size_t count = 1;
    for (; count < all.size(); ++count) {
      const Place next = of(all[count].second).place;
      const auto steps = static_cast<std::uint32_t>(count);
      if (all[count].first != all[0].first + steps || next.kind != first.kind ||
          next.port != first.port ||
          distance(first.offset, next.offset) != stride * static_cast<std::int32_t>(count)) {
        break;
      }
    }
    return count >= shortest_run ? count : 1;
  }

  Program& program_;
  std::span<const Index> places_;
  std::vector<Value> values_;
  Arrangement arrangement_;
  Registers registers_;
  Node before_ = {};
};

}  // namespace

void build(Program& program, const Graph& graph, std::span<const Node> outputs,
           std::span<const Index> places) {
  Builder(program, graph, outputs, places).build();
  encode(program);
}

}  // namespace saltus::tape::detail
