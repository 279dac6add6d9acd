// Enabled and triggered subsystems, as compositions.
#include "saltus/library/subsystems.hpp"

#include <algorithm>

#include "saltus/library/control_port.hpp"
#include "saltus/library/subsystem_output.hpp"
#include "saltus/model/diagram_builder.hpp"

namespace saltus {

namespace {

using InitialOutputs = std::map<std::string, Value>;

void require_outputs(const std::string& name, const System& part, const InitialOutputs& initial) {
  const std::vector<std::string> known = part.output_names();
  for (const auto& [output, value] : initial) detail::require_known(name, "output", output, known);
}

/// `of_outputs` is the execution as the outputs see it: they may be reset where the states are not.
Diagram controlled(std::string name, std::shared_ptr<const System> part, const std::string& port,
                   const Execution& execution, const Execution& of_outputs,
                   const InitialOutputs& initial) {
  require_outputs(name, *part, initial);
  DiagramBuilder builder;
  const System& inner = *part;
  builder.add(std::move(part));
  const auto& source = builder.add<ControlPort>(port);
  builder.execute(inner, source.output(), execution);
  const auto inputs = inner.input_names(), outputs = inner.output_names();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const int k = static_cast<int>(i);
    if (!inner.fixes_input(k)) builder.export_input(inner.input(k), inputs[i]);
  }
  builder.export_input(source.input(), port);
  for (const std::string& output : outputs) {
    const auto value = initial.find(output);
    const auto& held = builder.add<SubsystemOutput>(
        text("held_", output),
        SubsystemOutputOptions{value == initial.end() ? Value(0.0) : value->second, of_outputs});
    builder.connect(inner.output(output), held.input("in"));
    builder.connect(source.output(), held.input("control"));
    builder.export_output(held.output(), output);
  }
  return builder.build(std::move(name));
}

}  // namespace

Diagram enabled_subsystem(std::string name, std::shared_ptr<const System> part,
                          const EnabledSubsystemOptions& options) {
  return controlled(std::move(name), std::move(part), "enable", {.resets = options.resets_states},
                    {.resets = options.resets_outputs}, options.initial_outputs);
}

Diagram triggered_subsystem(std::string name, std::shared_ptr<const System> part,
                            const TriggeredSubsystemOptions& options) {
  const Execution execution{.kind = Execution::Kind::triggered, .edge = options.edge};
  return controlled(std::move(name), std::move(part), "trigger", execution, execution,
                    options.initial_outputs);
}

}  // namespace saltus
