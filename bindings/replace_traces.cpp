// New traces for a plan that exists.
#include <algorithm>
#include <utility>

#include "taped.hpp"
#include "traced_declarations.hpp"

namespace saltus::python {

namespace {

/// Whether a plan made with the old trace computes all that the new one needs.
bool fits(const PythonLeaf& leaf, const Trace& old, const Trace& now) {
  if (old.function != now.function) return false;
  if (old.serial == now.serial) return true;
  for (int k = 0; k < count_of(leaf.declarations().inputs); ++k)
    if (now.tape.reads_input(k) && !old.tape.reads_input(k)) return false;
  if (leaf.function(now.function).formula) return false;  // the plan may have fused it with others
  const Role role = leaf.function(now.function).role;
  if (role != Role::output && role != Role::relation) return true;
  const bool slower = (old.tape.reads() | now.tape.reads()) == old.tape.reads();
  return slower && !old.relations && !now.relations;
}

}  // namespace

bool replace_traces(const PythonLeaf& leaf, const std::vector<Slot>& slots,
                    std::span<const Trace> traces) {
  const auto fit = [&](const Slot& slot, const Trace& now) { return fits(leaf, *slot, now); };
  if (!std::ranges::equal(slots, traces, fit)) return false;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    Trace now = traces[i];
    if (now.jacobian && slots[i]->jacobian)
      now.jacobian = at_places(*now.jacobian, slots[i]->jacobian->entries);
    *slots[i] = std::move(now);
  }
  return true;
}

}  // namespace saltus::python
