// Diagram: blocks and wires as one system, nested to any depth.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

/// Made by DiagramBuilder. It owns its blocks; references that `add` returned remain valid as long
/// as it lives.
class Diagram final : public System {
 public:
  struct Child {
    std::shared_ptr<const System> system;
    std::string name;
  };
  struct Wire {
    OutputPort from;
    InputPort to;
  };
  struct ExportedInput {
    std::string name;
    InputPort port;
  };
  struct ExportedOutput {
    std::string name;
    OutputPort port;
  };

  /// A direct child by name; the ModelError for an unknown name lists the known names.
  const System& operator[](std::string_view child) const;
  const std::vector<Child>& children() const noexcept { return children_; }
  const std::vector<Wire>& wires() const noexcept { return wires_; }
  const std::vector<ExportedInput>& inputs() const noexcept { return inputs_; }
  const std::vector<ExportedOutput>& outputs() const noexcept { return outputs_; }

  std::vector<std::string> input_names() const override { return detail::names_of(inputs_); }
  std::vector<std::string> output_names() const override { return detail::names_of(outputs_); }
  void collect(Structure& out, const std::string& path) const override;

  LeafPort output_source(int index) const override {
    const OutputPort& port = outputs_[static_cast<std::size_t>(index)].port;
    return port.system->output_source(port.index);
  }
  LeafPort input_target(int index) const override {
    const InputPort& port = inputs_[static_cast<std::size_t>(index)].port;
    return port.system->input_target(port.index);
  }

 private:
  friend class DiagramBuilder;
  explicit Diagram(std::string name) : System(std::move(name)) {}

  std::vector<Child> children_;
  std::vector<Wire> wires_;
  std::vector<ExportedInput> inputs_;
  std::vector<ExportedOutput> outputs_;
};

inline const System& Diagram::operator[](std::string_view child) const {
  const auto found = std::ranges::find(children_, child, &Child::name);
  if (found != children_.end()) return *found->system;
  throw ModelError(text("diagram '", name(), "' has no block '", child, "'",
                        known_names(child, detail::names_of(children_))));
}

inline void Diagram::collect(Structure& out, const std::string& path) const {
  const std::size_t mine = out.systems.size();
  out.systems.push_back(
      {system_id(), path.empty() ? name() : path, out.leaves.size(), out.leaves.size()});
  for (const Child& child : children_) {
    child.system->collect(out, path.empty() ? child.name : path + "." + child.name);
  }
  for (const Wire& wire : wires_) {
    out.wires.push_back({wire.from.system->output_source(wire.from.index),
                         wire.to.system->input_target(wire.to.index)});
  }
  out.systems[mine].last = out.leaves.size();
}

}  // namespace saltus
