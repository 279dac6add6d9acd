// Evaluations: a run that is begun at a context, and goes nowhere.
#include "saltus/simulation/evaluate.hpp"

#include <algorithm>

#include "saltus/base/model_errors.hpp"
#include "saltus/model/detail/subcontext.hpp"
#include "saltus/plan/compile.hpp"
#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

namespace {

/// The memory of a run at its first instant, before anything happens there.
class Standstill {
 public:
  Standstill(const System& system, const RecordedSignals& signals, const Context& context)
      : machine_(compile(system, signals)),
        guards_(machine_.plan()),
        instant_(machine_, guards_, options_, results_),
        time_(context.time()) {
    require_context_of(machine_.plan(), context);
    machine_.load(context);
    const Continuation* earlier = context.continuation();
    if (earlier != nullptr && instant_.fits(*earlier))
      instant_.resume(time_, nullptr, *earlier, 0.0);
    else
      instant_.begin(time_, nullptr);
  }

  Eigen::VectorXd rates() {
    Eigen::VectorXd rates(machine_.x.size());
    machine_.derivative(time_, machine_.x.data(), rates.data());
    return rates;
  }

  SignalValue signal() {
    const Values values = machine_.evaluate_taps(time_, machine_.x.data());
    const Node& node = machine_.plan().node(machine_.plan().taps.front().node);
    return {VectorView(values(node.place), node.shape.size), node.shape};
  }

 private:
  SimulatorOptions options_;
  Results results_;
  Machine machine_;
  GuardSet guards_;
  Instant instant_;
  double time_;
};

bool same(const LeafPort& a, const LeafPort& b) { return a.leaf == b.leaf && a.index == b.index; }

}  // namespace

Eigen::VectorXd evaluate_time_derivatives(const System& system, const Context& context) {
  return Standstill(system, {}, context).rates();
}

Eigen::VectorXd evaluate_time_derivatives(const System& system, const Context& context,
                                          const System& part) {
  const Eigen::VectorXd rates = evaluate_time_derivatives(system, context);
  const Structure structure = structure_of(system);  // the context may be one of an equal system
  const SystemId id = part.itself().system_id();
  const auto range = std::ranges::find(structure.systems, id, &Layout::Range::id);
  if (range == structure.systems.end()) {
    throw ModelError(text("block '", part.name(), "' is not part of system '", system.name(), "'"));
  }
  const auto [first, count] =
      detail::extent(context.layout(), *range, &Layout::Leaf::x, &Layout::Leaf::nx);
  return rates.segment(first, count);
}

SignalValue evaluate_output(const System& system, OutputPort port, const Context& context) {
  return Standstill(system, {{"y", port}}, context).signal();
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
