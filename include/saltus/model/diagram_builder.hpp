// DiagramBuilder: add, connect, export_input, export_output, build.
#pragma once

#include <concepts>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "saltus/model/diagram.hpp"

namespace saltus {

/// Collects blocks and wires; `build` uses it up. Throws ModelError for a name used twice, a port
/// of a block that was not added, an input with two sources, and, in `build`, for an input without
/// a source.
class DiagramBuilder {
 public:
  /// Makes a block in place. The returned reference remains valid in the diagram.
  template <std::derived_from<System> Block, class... Arguments>
  Block& add(Arguments&&... arguments) {
    auto block = std::make_shared<Block>(std::forward<Arguments>(arguments)...);
    Block& reference = *block;
    add(std::move(block));
    return reference;
  }

  /// Adds a block that exists already, for example a diagram:
  /// `add(std::make_shared<Diagram>(inner.build("inner")))`.
  void add(std::shared_ptr<const System> block) {
    require_unspent();
    std::string name =
        block->name().empty() ? text("block_", block->system_id().value) : block->name();
    if (mine_.contains(block.get())) throw ModelError(text("block '", name, "' is added twice"));
    if (!names_.insert(name).second) {
      throw ModelError(
          text("two blocks are called '", name, "'; give each block of a diagram its own name"));
    }
    mine_.emplace(block.get(), diagram_.children_.size());
    diagram_.children_.push_back({std::move(block), std::move(name)});
  }

  void connect(OutputPort from, InputPort to) {
    require_mine(from.system);
    require_free(to);
    sources_.emplace(std::pair(to.system, to.index), diagram_.wires_.size());
    diagram_.wires_.push_back({from, to});
  }

  /// Makes an input of a block an input of the diagram; returns its position there.
  int export_input(InputPort port, std::string name = {}) {
    require_free(port);
    if (name.empty()) name = text(name_of(port.system), "_", port_name(port));
    detail::name_it(name, diagram_.inputs_, "in_", "the diagram");
    diagram_.inputs_.push_back({std::move(name), port});
    return static_cast<int>(diagram_.inputs_.size()) - 1;
  }

  /// Makes an output of a block an output of the diagram; returns its position there.
  int export_output(OutputPort port, std::string name = {}) {
    require_mine(port.system);
    if (name.empty()) {
      name = text(name_of(port.system), "_",
                  port.system->output_names()[static_cast<std::size_t>(port.index)]);
    }
    detail::name_it(name, diagram_.outputs_, "out_", "the diagram");
    diagram_.outputs_.push_back({std::move(name), port});
    return static_cast<int>(diagram_.outputs_.size()) - 1;
  }

  Diagram build(std::string name = "root") {
    require_unspent();
    if (diagram_.children_.empty())
      throw ModelError("build: the diagram has no block; add one first");
    for (const auto& child : diagram_.children_) {
      const auto ports = child.system->input_names();
      for (int i = 0; i < static_cast<int>(ports.size()); ++i) {
        if (source_of({child.system.get(), i}).empty()) {
          throw ModelError(text("input '", ports[static_cast<std::size_t>(i)], "' of block '",
                                child.name, "' is not connected; connect it or export it"));
        }
      }
    }
    spent_ = true;
    Diagram built(std::move(name));
    built.children_ = std::move(diagram_.children_);
    built.wires_ = std::move(diagram_.wires_);
    built.inputs_ = std::move(diagram_.inputs_);
    built.outputs_ = std::move(diagram_.outputs_);
    return built;
  }

 private:
  void require_unspent() const {
    if (spent_) throw ModelError("this DiagramBuilder was spent by build(); make a new one");
  }

  void require_mine(const System* system) const {
    require_unspent();
    if (!mine_.contains(system)) {
      throw ModelError(text("block '", system->name(),
                            "' was not added to this diagram; its blocks: ",
                            quoted_list(detail::names_of(diagram_.children_))));
    }
  }

  void require_free(InputPort to) const {
    require_mine(to.system);
    if (const std::string source = source_of(to); !source.empty()) {
      throw ModelError(text("input '", port_name(to), "' of block '", name_of(to.system),
                            "' already has a source, ", source, "; an input takes one"));
    }
  }

  /// The source of an input, in words; empty if it has none.
  std::string source_of(InputPort to) const {
    if (const auto wire = sources_.find({to.system, to.index}); wire != sources_.end())
      return text("block '", name_of(diagram_.wires_[wire->second].from.system), "'");
    for (const auto& input : diagram_.inputs_) {
      if (input.port.system == to.system && input.port.index == to.index)
        return text("the exported input '", input.name, "'");
    }
    return {};
  }

  std::string name_of(const System* system) const {
    return diagram_.children_[mine_.at(system)].name;
  }
  static std::string port_name(InputPort port) {
    return port.system->input_names()[static_cast<std::size_t>(port.index)];
  }

  Diagram diagram_{""};
  bool spent_ = false;
  // Look-up tables: with ten thousand blocks a search of the lists would be slow.
  std::unordered_map<const System*, std::size_t> mine_;           // place in children_
  std::unordered_set<std::string> names_;                         // of children_
  std::map<std::pair<const System*, int>, std::size_t> sources_;  // inputs: place in wires_
};

}  // namespace saltus
