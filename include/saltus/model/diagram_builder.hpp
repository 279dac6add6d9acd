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
#include "saltus/tape/symbol.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus {

class DiagramParameters;

/// The parameters of a diagram as symbols, for DiagramBuilder::compute_parameter.
class ParameterSymbols {
 public:
  explicit ParameterSymbols(tape::Graph& graph) : graph_(&graph) {}
  tape::Symbol operator()(ParameterIndex parameter, Index entry = 0) const {
    return {*graph_, graph_->parameter(parameter.offset + entry)};
  }

 private:
  tape::Graph* graph_;
};

/// Collects blocks and wires; `build` uses it up. Throws ModelError for a name used twice, a port
/// of a block that was not added, an input with two sources, and, in `build`, for an input without
/// a source.
class DiagramBuilder {
 public:
  DiagramBuilder();
  ~DiagramBuilder();
  DiagramBuilder(DiagramBuilder&&) noexcept;
  DiagramBuilder& operator=(DiagramBuilder&&) noexcept;

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
  void add(std::shared_ptr<const System> block);

  void connect(OutputPort from, InputPort to);

  /// Leads an event of one leaf to an event input of another, or of the same: each firing of the
  /// event applies the reset map of the input, with the weight of the wire.
  ///
  ///     builder.connect_event(a.event_output("fire"), b.event_input("synapse"), 0.5, 1e-3);
  ///
  /// With a delay of 0 s that is in the next pass of the instant; otherwise `delay` [s] later, at an
  /// exact stop. Any number of wires may leave one event and lead to one input. Deliveries of one
  /// pass follow each other in the order in which their wires were declared. Throws ModelError for a
  /// block that was not added, a weight that is not finite, and a delay that is negative or not
  /// finite. `compile` throws ModelError for a block in a part with a control signal.
  void connect_event(EventOutputPort from, EventInputPort to, double weight = 1.0,
                     double delay = 0.0);

  /// Makes an event, or an input for events, of a block one of the diagram; returns its position
  /// there. An entry is named where the wire is made.
  int export_event_output(EventOutputPort port, std::string name = {});
  int export_event_input(EventInputPort port, std::string name = {});

  /// Executes a block only while, or only when, a signal of this diagram says so: see Execution.
  ///
  /// Enabled: while the signal is false, xdot = 0 for all continuous states of the block, its
  /// updates, resets and edges write nothing, and its guards are not seen. When the signal becomes
  /// true, its guards are armed as where a mode is entered, and what rested at a Zeno point rests on.
  /// Its outputs are computed as before.
  ///
  /// Triggered: at each edge of the signal its updates with an inherited period run once, together,
  /// and read the values before the edge.
  ///
  /// Throws ModelError for a block or a port that was not added, for a block that has a control
  /// signal already, and for a signal of the block itself. `compile` throws ModelError for a signal
  /// that is not one held value, and for a block that cannot be executed in this way: one with a
  /// history or a queued zero crossing; if triggered, one with a continuous state, a guard, an edge,
  /// or an update with a period of its own.
  void execute(const System& block, OutputPort control, Execution execution);

  /// Declares a parameter of the diagram: `context.with_parameter(name, value)`, in a diagram that
  /// contains this one by its path, "car.mass". Throws ModelError for a name that is taken.
  ParameterIndex declare_parameter(std::string name, double value);
  ParameterIndex declare_parameter(std::string name, const Eigen::VectorXd& value);

  /// Computes a parameter of a block, or of a diagram in this one, from the parameters of this
  /// diagram: `function(p)` returns a number, or a vector of numbers, where p(m) is the parameter m
  /// and p(k, i) entry i of the vector k. It is called once, with symbols for the numbers. From then
  /// on the parameter follows, and it cannot be set any more.
  ///
  ///     const ParameterIndex m = builder.declare_parameter("mass", 2.0);
  ///     builder.compute_parameter(weight, "gain", [=](const auto& p) { return -9.81 * p(m); });
  ///
  /// Throws ModelError for a parameter that the block does not have, for another number of values
  /// than it has, and, in `build`, for a block that is not in the diagram and for a parameter that
  /// is computed twice.
  template <std::invocable<const ParameterSymbols&> Function>
  void compute_parameter(const System& block, std::string_view parameter,
                         const Function& function) {
    tape::Graph graph;
    compute_parameter(block, parameter, tape_of(graph, function(ParameterSymbols(graph))));
  }
  /// The same by a tape that reads the parameters of the diagram, in the order of their
  /// declaration, and nothing else.
  void compute_parameter(const System& block, std::string_view parameter, tape::Tape values);

  /// Makes an input of a block an input of the diagram; returns its position there.
  int export_input(InputPort port, std::string name = {});

  /// Makes an output of a block an output of the diagram; returns its position there.
  int export_output(OutputPort port, std::string name = {});

  Diagram build(std::string name = "root");

 private:
  static tape::Tape tape_of(tape::Graph& graph, const tape::Symbol& value);
  static tape::Tape tape_of(tape::Graph& graph, const std::vector<tape::Symbol>& values);
  DiagramParameters& parameters();
  void require_computed_once() const;
  void require_unspent() const;
  void require_mine(const System* system) const;
  void require_free(InputPort to) const;
  [[noreturn]] void throw_two_sources(InputPort to) const;

  /// The source of an input, in words; empty if it has none.
  std::string source_of(InputPort to) const;
  std::string name_of(const System* system) const;
  static std::string port_name(InputPort port);

  Diagram diagram_{""};
  std::shared_ptr<DiagramParameters> parameters_;  // null until one is declared
  bool spent_ = false;
  // Look-up tables: with ten thousand blocks a search of the lists would be slow.
  std::unordered_map<const System*, std::size_t> mine_;           // place in children_
  std::unordered_set<std::string> names_;                         // of children_
  std::map<std::pair<const System*, int>, std::size_t> sources_;  // inputs: place in wires_
};

}  // namespace saltus
