// Soundness: algebraic loops and widths of a diagram that is being built.
#include "saltus/model/detail/soundness.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "saltus/model/detail/feedthrough_order.hpp"

namespace saltus::detail {

namespace {

/// The outputs of all leaves as nodes of a graph. A relation is held between instants, so an output
/// that reads it does not need the inputs of the relation.
class Wiring {
 public:
  explicit Wiring(const Diagram& diagram) {
    add(diagram, "");
    for (const Leaf& leaf : leaves_) {
      for (int i = 0; i < static_cast<int>(leaf.declared().outputs.size()); ++i)
        nodes_.push_back({numbers_.at(leaf.system), i});
    }
    connect(diagram);
  }

  struct Leaf {
    const LeafSystem* system;
    std::string path;
    std::size_t first;  // its first output among the nodes
    List<int> sources;  // the node that feeds each input; -1: open
    const Declarations& declared() const { return system->declarations(); }
  };
  struct Node {
    std::size_t leaf;
    int output;
  };

  const std::vector<Leaf>& leaves() const { return leaves_; }
  std::size_t size() const { return nodes_.size(); }
  const Leaf& leaf_of(int node) const { return leaves_[at(node).leaf]; }
  const OutputDeclaration& output_of(int node) const {
    return leaf_of(node).declared().outputs[at(node).output];
  }
  std::string name_of(int node) const {
    return text(leaf_of(node).path, ".", output_of(node).name);
  }

  /// The nodes that an output reads at the same time.
  std::vector<int> needs(int node) const {
    const OutputDeclaration& output = output_of(node);
    const std::vector<int>& sources = leaf_of(node).sources;
    if (output.view || !has(output.reads, Reads::inputs)) return {};
    std::vector<int> read;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const bool reads = !output.inputs || std::ranges::find(*output.inputs, static_cast<int>(i)) !=
                                               output.inputs->end();
      if (reads && sources[i] >= 0) read.push_back(sources[i]);
    }
    return read;
  }

 private:
  const Node& at(int node) const { return nodes_[node]; }

  void add(const System& system, const std::string& path) {
    if (const auto* diagram = dynamic_cast<const Diagram*>(&system.itself())) {
      for (const Diagram::Child& child : diagram->children())
        add(*child.system, path.empty() ? child.name : path + "." + child.name);
    } else if (const auto* leaf = dynamic_cast<const LeafSystem*>(&system.itself())) {
      numbers_.emplace(leaf, leaves_.size());
      leaves_.push_back(
          {leaf, path, outputs_, std::vector(leaf->declarations().inputs.size(), -1)});
      outputs_ += leaf->declarations().outputs.size();
      add_samplers(*leaf, path);
    }
  }

  void add_samplers(const LeafSystem& leaf, const std::string& path) {
    const std::size_t first = leaves_.back().first;
    const auto& outputs = leaf.declarations().outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const OutputDeclaration& output = nth(outputs, i);
      if (!output.sampler) continue;
      add(*output.sampler, path + "." + output.name);
      leaves_[numbers_.at(output.sampler.get())].sources[0] = static_cast<int>(first + i);
    }
  }

  void connect(const System& system) {
    const auto* diagram = dynamic_cast<const Diagram*>(&system.itself());
    if (diagram == nullptr) return;
    for (const Diagram::Wire& wire : diagram->wires()) {
      const LeafPort from = wire.from.system->output_source(wire.from.index),
                     to = wire.to.system->input_target(wire.to.index);
      Leaf& reader = leaves_[numbers_.at(to.leaf)];
      reader.sources[to.index] =
          static_cast<int>(leaves_[numbers_.at(from.leaf)].first) + from.index;
    }
    for (const Diagram::Child& child : diagram->children()) connect(*child.system);
  }

  std::vector<Leaf> leaves_;
  List<Node> nodes_;
  std::unordered_map<const LeafSystem*, std::size_t> numbers_;
  std::size_t outputs_ = 0;
};

/// Finds the shapes of all nodes as far as they are known. A rule that gives no entries does not
/// know the shape yet.
class Widths {
 public:
  Widths(const Wiring& wiring, const std::vector<int>& order)
      : wiring_(wiring), shapes_(wiring.size()) {
    for (bool found = true; found;) {
      found = false;
      for (const int i : order) found = look(i) || found;
    }
  }

  void check() const {
    for (const Wiring::Leaf& leaf : wiring_.leaves()) {
      for (std::size_t i = 0; i < leaf.sources.size(); ++i) {
        const int source = leaf.sources[i];
        const InputDeclaration& input = leaf.declared().inputs[i];
        if (source < 0 || !input.shape) continue;
        const std::optional<Shape>& found = shapes_[source];
        if (found && !input.takes(*found))
          throw_wrong_shape(input.name, leaf.path, *input.shape, *found,
                            text("output '", wiring_.name_of(source), "'"));
      }
    }
  }

 private:
  /// Finds the shape of a node, if it can be known; returns whether it has become known now.
  bool look(int i) {
    std::optional<Shape>& shape = shapes_[i];
    if (shape) return false;
    shape = shape_of(i);
    return shape.has_value();
  }

  std::optional<Shape> shape_of(int i) const {
    const OutputDeclaration& output = wiring_.output_of(i);
    if (output.shape) return output.shape;
    std::vector<Shape> inputs;
    for (const int source : wiring_.leaf_of(i).sources) {
      if (source < 0 || !shapes_[source]) return std::nullopt;
      inputs.push_back(*shapes_[source]);
    }
    const Shape shape = output.shape_rule ? output.shape_rule(inputs) : elementwise(inputs);
    return shape.size > 0 ? std::optional(shape) : std::nullopt;
  }

  const Wiring& wiring_;
  List<std::optional<Shape>> shapes_;
};

}  // namespace

void require_sound(const Diagram& diagram) {
  const Wiring wiring(diagram);
  const auto needs = [&](int i) { return wiring.needs(i); };
  const auto name = [&](int i) { return wiring.name_of(i); };
  const std::vector<int> order = FeedthroughOrder(wiring.size(), needs, name).run();
  Widths(wiring, order).check();
}

}  // namespace saltus::detail
