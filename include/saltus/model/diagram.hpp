// Diagram: blocks and wires as one system, nested to any depth.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
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
  /// A wire from an event to an input for events.
  struct EventWire {
    EventOutputPort from;
    EventInputPort to;
    double weight = 1.0, delay = 0.0;  ///< delay [s]
  };
  struct ExportedEventOutput {
    std::string name;
    EventOutputPort port;
  };
  struct ExportedEventInput {
    std::string name;
    EventInputPort port;
  };
  struct ExportedInput {
    std::string name;
    InputPort port;
  };
  struct ExportedOutput {
    std::string name;
    OutputPort port;
  };

  /// A child that is executed as a signal of this diagram says.
  struct Controlled {
    const System* child;
    OutputPort control;
    Execution execution;
  };

  /// A parameter of a block as a function of the parameters of this diagram.
  struct Computed {
    const LeafSystem* leaf;
    std::string parameter;
    std::shared_ptr<const tape::Tape> values;
  };

  /// A direct child by name; the ModelError for an unknown name lists the known names.
  const System& operator[](std::string_view child) const;
  const std::vector<Child>& children() const noexcept { return children_; }
  const std::vector<Wire>& wires() const noexcept { return wires_; }
  const std::vector<EventWire>& event_wires() const noexcept { return event_wires_; }
  const std::vector<Controlled>& controlled() const noexcept { return controlled_; }
  /// The block that holds the parameters of this diagram; null if it has none.
  const LeafSystem* parameters() const noexcept { return parameters_.get(); }
  const std::vector<ExportedInput>& inputs() const noexcept { return inputs_; }
  const std::vector<ExportedOutput>& outputs() const noexcept { return outputs_; }

  std::vector<std::string> input_names() const override;
  std::vector<std::string> output_names() const override;
  void collect(Structure& out, const std::string& path) const override;

  bool fixes_input(int index) const override;
  LeafPort output_source(int index) const override;
  LeafPort input_target(int index) const override;

  std::vector<std::string> event_output_names() const override;
  std::vector<std::string> event_input_names() const override;
  LeafEvent event_source(int index) const override;
  LeafEvent event_target(int index) const override;

 private:
  friend class DiagramBuilder;
  explicit Diagram(std::string name) : System(std::move(name)) {}

  std::vector<Child> children_;
  std::vector<Wire> wires_;
  std::vector<EventWire> event_wires_;
  std::vector<Controlled> controlled_;
  List<ExportedInput> inputs_;
  List<ExportedOutput> outputs_;
  List<ExportedEventOutput> event_outputs_;
  List<ExportedEventInput> event_inputs_;
  std::shared_ptr<const LeafSystem> parameters_;
  std::vector<Computed> computed_;
  std::vector<std::shared_ptr<const void>> uses_;  // of its leaves, see Declarations
};

}  // namespace saltus
