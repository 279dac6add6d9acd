// Evaluations: the values at the begin of a run that goes nowhere.
#include "saltus/simulation/evaluate.hpp"

#include <algorithm>

#include "saltus/base/model_errors.hpp"
#include "saltus/model/detail/subcontext.hpp"
#include "saltus/simulation/detail/standstill.hpp"

namespace saltus {

namespace {

Eigen::VectorXd rates(Standstill& at) {
  Machine& machine = at.machine();
  Eigen::VectorXd rates(machine.x.size());
  machine.derivative(at.time(), machine.x.data(), rates.data());
  return rates;
}

SignalValue signal(Standstill& at) {
  Machine& machine = at.machine();
  const Values values = machine.evaluate_taps(at.time(), machine.x.data());
  const Node& node = machine.plan().node(machine.plan().taps.front().node);
  return {VectorView(values(node.place), node.shape.size), node.shape};
}

bool same(const LeafPort& a, const LeafPort& b) { return a.leaf == b.leaf && a.index == b.index; }

}  // namespace

Eigen::VectorXd evaluate_time_derivatives(const System& system, const Context& context) {
  Standstill at(compile(system));
  at.begin(context);
  return rates(at);
}

Eigen::VectorXd evaluate_time_derivatives(const System& system, const Context& context,
                                          const System& part) {
  const Eigen::VectorXd all = evaluate_time_derivatives(system, context);
  const Structure structure = structure_of(system);  // the context may be one of an equal system
  const SystemId id = part.itself().system_id();
  const auto range = std::ranges::find(structure.systems, id, &Layout::Range::id);
  if (range == structure.systems.end()) {
    throw ModelError(text("block '", part.name(), "' is not part of system '", system.name(), "'"));
  }
  const auto [first, count] =
      detail::extent(context.layout(), *range, &Layout::Leaf::x, &Layout::Leaf::nx);
  return all.segment(first, count);
}

SignalValue evaluate_output(const System& system, OutputPort port, const Context& context) {
  Standstill at(compile(system, {{"y", port}}));
  at.begin(context);
  return signal(at);
}

SignalValue evaluate_input(const System& system, InputPort port, const Context& context) {
  const LeafPort target = port.system->input_target(port.system->input(port.index).index);
  const Structure structure = structure_of(system);
  const auto leads_there = [&](const auto& way) { return same(way.to, target); };
  if (const auto wire = std::ranges::find_if(structure.wires, leads_there);
      wire != structure.wires.end())
    return evaluate_output(system, {wire->from.leaf, wire->from.index}, context);
  const auto fixed =
      std::ranges::find_if(structure.fixed.rbegin(), structure.fixed.rend(), leads_there);
  if (fixed != structure.fixed.rend()) return {fixed->value, fixed->shape};
  throw InputNotConnectedError(text(
      "input '", nth(port.system->input_names(), port.index), "' of block '", port.system->name(),
      "' has no source in system '", system.name(), "'; connect it, or fix its value"));
}

}  // namespace saltus
