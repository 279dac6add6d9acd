#include "trace_pass.hpp"

#include <pybind11/stl.h>

#include "bind_traces.hpp"
#include "interpreter.hpp"

namespace saltus::python {

std::shared_ptr<const Declarations> TracePass::before(const LeafSystem& leaf) {
  const auto number = traces_->number_of(leaf);
  return number && traces_->blocks()[*number].traced ? declarations_of(*number) : nullptr;
}

std::shared_ptr<const Declarations> TracePass::with_shapes(const Plan& plan, const PlanLeaf& leaf) {
  const auto number = traces_->number_of(*leaf.system);
  if (!number) return nullptr;
  BlockTraces& block = traces_->blocks()[*number];
  block.take_shapes(plan, leaf);
  traces_->set(*number, ask(trace_block_, *number, facts_of(block)).cast<std::vector<Trace>>());
  return declarations_of(*number);
}

std::shared_ptr<const Declarations> TracePass::declarations_of(std::size_t number) {
  const BlockTraces& block = traces_->blocks()[number];
  slots_.resize(traces_->blocks().size());
  shared_.resize(slots_.size());
  shared_[number] = block.shared;
  std::vector<Slot>& slots = slots_[number];
  slots.clear();
  for (const Trace& trace : block.traces) slots.push_back(std::make_shared<Trace>(trace));
  return traced_declarations(*block.leaf, block.outputs, slots, block.shared);
}

bool TracePass::replace() {
  bool all = true;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const BlockTraces& block = traces_->blocks()[i];
    all = replace_traces(*block.leaf, slots_[i], block.traces) && block.shared == shared_[i] && all;
  }
  return all;
}

std::shared_ptr<Interpreted> interpreted_by(const py::object& callbacks) {
  if (callbacks.is_none()) return std::make_shared<Interpreted>();
  return callbacks.attr("traces").cast<std::shared_ptr<Traces>>()->interpreted();
}

std::shared_ptr<TracePass> trace_pass(const py::object& callbacks) {
  if (callbacks.is_none()) return nullptr;
  auto traces = callbacks.attr("traces").cast<std::shared_ptr<Traces>>();
  if (traces->blocks().empty()) return nullptr;
  return std::make_shared<TracePass>(std::move(traces), callbacks.attr("trace_block"));
}

}  // namespace saltus::python
