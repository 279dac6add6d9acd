// Makes the blocks, frames and wires of a system's picture.
#include "saltus/plan/picture.hpp"
#include "saltus/base/list.hpp"

#include <map>
#include <tuple>
#include <unordered_map>

#include "parts.hpp"
#include "saltus/model/diagram_builder.hpp"
#include "saltus/plan/compile.hpp"

namespace saltus {

namespace {

using namespace detail;
using Block = Picture::Block;

/// Feeds an open input of the drawn system with a continuous signal of its shape.
class OpenInput final : public LeafSystem {
 public:
  explicit OpenInput(LeafPort target) {
    const auto& input = target.leaf->declarations().inputs[target.index];
    declare_output_port({.calc = [](const At&, VectorRef y) { y.setZero(); },
                         .shape = input.shape.value_or(Shape::scalar()),
                         .reads = Reads::time});
  }
};

/// The system with all its inputs fed, so that it compiles; its own leaves come first.
std::unique_ptr<const System> closed(const System& system) {
  DiagramBuilder builder;
  builder.add(std::shared_ptr<const System>(std::shared_ptr<void>(), &system));
  const int inputs = static_cast<int>(system.input_names().size());
  for (int i = 0; i < inputs; ++i)
    builder.connect(builder.add<OpenInput>(system.input_target(i)).output(), {&system, i});
  return std::make_unique<Diagram>(builder.build());
}

/// Walks the system as it was built: a frame for each diagram, a block for each leaf.
class Drawing {
 public:
  Drawing(const System& root, const PictureOptions& options) : root_(root), options_(options) {
    picture_.name = root.name();
    make_plan();
  }

  Picture draw() {
    if (const auto* diagram = as_diagram(root_); diagram != nullptr && options_.max_depth > 0) {
      draw_inside(root_, *diagram, -1, 1);
    } else {
      add_block(root_, root_.name(), -1);
    }
    return std::move(picture_);
  }

 private:
  struct Ends {  // the ends of a system's wires: the block, or one block for each port
    std::vector<int> inputs, outputs;
    int block = -1, frame = -1;
  };

  static const Diagram* as_diagram(const System& system) {
    return dynamic_cast<const Diagram*>(&system.itself());
  }

  void make_plan() {
    try {
      whole_ = closed(root_);
      plan_ = compile(*whole_);
    } catch (const ModelError& error) {
      picture_.trouble = error.what();
      return;
    }
    plan_ = compile(*whole_, recorded());
    readings_ = readings_of(*plan_);
    for (std::size_t i = 0; i < plan_->leaves.size(); ++i)
      number_[plan_->leaves[i].system] = static_cast<int>(i);
  }

  RecordedSignals recorded() const {
    if (options_.recorded_signals) return *options_.recorded_signals;
    RecordedSignals all;
    const int outputs = static_cast<int>(root_.output_names().size());
    for (int i = 0; i < outputs; ++i) all.push_back({text(i), {&root_, i}});
    return all;
  }

  void draw_inside(const System& system, const Diagram& diagram, int frame, int depth) {
    for (const Diagram::Child& child : diagram.children()) {
      const Diagram* inner = as_diagram(*child.system);
      if (inner == nullptr || depth >= options_.max_depth) {
        add_block(*child.system, child.name, frame);
        continue;
      }
      const int inside = static_cast<int>(picture_.frames.size());
      picture_.frames.push_back({frame, child.name});
      draw_inside(*child.system, *inner, inside, depth + 1);
      ends_[child.system.get()].frame = inside;
    }
    Ends& ends = ends_[&system];
    add_ports(diagram, ends, frame);
    add_wires(diagram, ends);
    add_controls(diagram);
    add_event_wires(diagram);
  }

  void add_block(const System& system, const std::string& name, int frame) {
    Block block{.frame = frame,
                .name = name,
                .type = system.kind(),
                .inputs = system.input_names(),
                .outputs = system.output_names()};
    if (const auto* leaf = dynamic_cast<const LeafSystem*>(&system.itself())) {
      const int number = plan_ ? number_.at(leaf) : -1;
      block.notes = notes_of(*leaf, plan_.get(), number);
      if (plan_) block.flow = flow_of(*plan_, plan_->leaves[number]);
    } else {
      block.kind = Block::Kind::diagram;
    }
    const int number = add(std::move(block));
    ends_[&system].block = number;
    for (const Structure::Leaf& leaf : structure_of(system).leaves) block_of_[leaf.system] = number;
  }

  int add(Block block) {
    picture_.blocks.push_back(std::move(block));
    return static_cast<int>(picture_.blocks.size()) - 1;
  }

  /// The ports of a diagram are small blocks at its border; wires pass through them.
  void add_ports(const Diagram& diagram, Ends& ends, int frame) {
    const auto border = [&](Block::Kind kind, const std::vector<std::string>& names) {
      std::vector<int> blocks;
      for (const std::string& name : names) {
        blocks.push_back(add(
            {.kind = kind, .frame = frame, .name = name, .inputs = {"in"}, .outputs = {"out"}}));
      }
      return blocks;
    };
    ends.inputs = border(Block::Kind::input, diagram.input_names());
    ends.outputs = border(Block::Kind::output, diagram.output_names());
  }

  void add_wires(const Diagram& diagram, const Ends& ends) {
    for (std::size_t i = 0; i < diagram.inputs().size(); ++i) {
      const InputPort to = diagram.inputs()[i].port;
      add_wire({ends.inputs[i], 0}, end_of(to), to.system->input_target(to.index), true);
    }
    for (const Diagram::Wire& wire : diagram.wires()) {
      add_wire(end_of(wire.from), end_of(wire.to), wire.to.system->input_target(wire.to.index),
               true);
    }
    for (std::size_t i = 0; i < diagram.outputs().size(); ++i) {
      const OutputPort from = diagram.outputs()[i].port;
      add_wire(end_of(from), {ends.outputs[i], 0}, from.system->output_source(from.index), false);
    }
  }

  using End = std::pair<int, int>;  // block and port
  End end_of(OutputPort port) {
    const Ends& ends = ends_[port.system];
    return ends.block >= 0 ? End{ends.block, port.index} : End{nth(ends.outputs, port.index), 0};
  }
  End end_of(InputPort port) {
    const Ends& ends = ends_[port.system];
    return ends.block >= 0 ? End{ends.block, port.index} : End{nth(ends.inputs, port.index), 0};
  }

  /// `leaf` is the leaf's port at the end of the wire: an input that reads it, or the output that
  /// feeds it.
  void add_wire(End from, End to, LeafPort port, bool input) {
    Picture::Wire wire{
        .from = from.first, .output = from.second, .to = to.first, .input = to.second};
    if (plan_) {
      const int leaf = number_.at(port.leaf), index = port.index;
      const PlanLeaf& of = plan_->leaves[leaf];
      const Node& node = plan_->node(input ? of.inputs[index] : of.outputs[index]);
      wire.flow = flow_of(node), wire.width = node.shape.size;
      wire.columns = node.shape.columns;
      if (input) {
        const Reading reading = nth(nth(readings_, leaf), index);
        wire.event = reading.event && !reading.flow;
        if (!reading.event && !reading.flow) wire.flow = Picture::Flow::dropped;
      }
    }
    show(wire.from, wire.flow), show(wire.to, wire.flow);
    picture_.wires.push_back(wire);
  }

  void add_controls(const Diagram& diagram) {
    for (const Diagram::Controlled& part : diagram.controlled()) {
      const OutputPort control = part.control;
      const auto [from, output] = end_of(control);
      const Ends& to = ends_[part.child];
      const LeafPort source = control.system->output_source(control.index);
      const Picture::Flow flow =
          plan_ ? flow_of(plan_->node(plan_->leaves[number_.at(source.leaf)].outputs[source.index]))
                : Picture::Flow::unknown;
      picture_.controls.push_back(
          {from, output, to.block, to.frame, words_of(part.execution), flow});
    }
  }

  /// Wires between the same events and inputs are one edge. Ports at a border are passed.
  void add_event_wires(const Diagram& diagram) {
    std::map<std::tuple<int, int, std::string>, std::size_t> known;
    for (const Diagram::EventWire& wire : diagram.event_wires()) {
      const LeafEvent from = wire.from.system->event_source(wire.from.index),
                      to = wire.to.system->event_target(wire.to.index);
      const std::string words = text(nth(from.leaf->event_output_names(), from.index), " → ",
                                     nth(to.leaf->event_input_names(), to.index));
      const int begin = block_of_.at(from.leaf), end = block_of_.at(to.leaf);
      const auto [one, is_new] =
          known.try_emplace({begin, end, words}, picture_.event_wires.size());
      if (is_new)
        picture_.event_wires.push_back({begin, end, words});
      else
        ++picture_.event_wires[one->second].count;
    }
  }

  /// A port at a border has the colour of the signal through it.
  void show(int block, Picture::Flow flow) {
    Block& port = nth(picture_.blocks, block);
    if (port.kind == Block::Kind::input || port.kind == Block::Kind::output) {
      if (port.flow == Picture::Flow::unknown || port.flow == Picture::Flow::dropped)
        port.flow = flow;
    }
  }

  const System& root_;
  const PictureOptions& options_;
  std::unique_ptr<const System> whole_;
  std::shared_ptr<const Plan> plan_;
  Readings readings_;
  std::unordered_map<const LeafSystem*, int> number_;
  std::unordered_map<const System*, Ends> ends_;
  std::unordered_map<const LeafSystem*, int> block_of_;  // the drawn block that a leaf is in
  Picture picture_;
};

}  // namespace

Picture picture(const System& system, const PictureOptions& options) {
  return Drawing(system, options).draw();
}

std::string dimensions_of(const Picture::Wire& wire) {
  return wire.columns > 0 ? text(wire.width / wire.columns, " x ", wire.columns) : text(wire.width);
}

std::string event_label(const Picture::EventWire& wire) {
  return wire.count == 1 ? wire.words : text(wire.words, " (", wire.count, ")");
}

bool obvious(const std::vector<std::string>& ports, std::string_view usual) {
  return ports.empty() || (ports.size() == 1 && ports.front() == usual);
}

}  // namespace saltus
