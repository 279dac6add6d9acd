// Parts of a diagram that are executed as a control signal says.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "saltus/library/detail/arguments.hpp"
#include "saltus/model/diagram.hpp"

namespace saltus {

struct EnabledSubsystemOptions {
  /// Whether all states of the part return to their declared initial values each time it is enabled
  /// during a run. Otherwise they continue from where they rested.
  bool resets_states = false;
  /// Whether the outputs are `initial_outputs` while the part is not enabled. Otherwise they are
  /// held at their last values.
  bool resets_outputs = false;
  /// By name of the output; 0 where none is given. Each gives the shape of its output.
  std::map<std::string, Value> initial_outputs = {};
};

/// A diagram that executes `part` while its last input, "enable", is above 0. Its other ports are
/// those of `part`. While the part is not enabled, its continuous states rest, its guards are not
/// seen, and its resets and updates write nothing: see DiagramBuilder::execute. The diagram has a
/// ControlPort "enable" and a SubsystemOutput "held_NAME" for each output.
///
/// Throws ModelError for an unknown name among the initial outputs.
Diagram enabled_subsystem(std::string name, std::shared_ptr<const System> part,
                          const EnabledSubsystemOptions& options = {});

struct TriggeredSubsystemOptions {
  Edge edge = Edge::rising;
  /// The outputs before the first trigger, by name; 0 where none is given. Each gives the shape of
  /// its output.
  std::map<std::string, Value> initial_outputs = {};
};

/// A diagram that executes `part` once at each edge of its last input, "trigger", which is true
/// while it is above 0. Its other ports are those of `part`. At an edge the outputs take the values
/// that the part has there, and then all of its updates with an inherited period run together. A
/// trigger that is true at the start of a run has no edge there.
///
/// Throws ModelError for an unknown name among the initial outputs. `compile` throws ModelError for
/// a part with a continuous state, a guard, or a sample time of its own.
Diagram triggered_subsystem(std::string name, std::shared_ptr<const System> part,
                            const TriggeredSubsystemOptions& options = {});

}  // namespace saltus
