// LadderLeaf: a Python block as it runs, with tapes in place of those functions that have one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "survey.hpp"
#include "trace.hpp"

namespace saltus::python {

/// It has the states, ports, parameters and events of the Python block, and its functions where
/// there is no tape.
class LadderLeaf final : public LeafSystem {
 public:
  LadderLeaf(const SurveyedBlock& block, std::span<const Trace> traces);

  /// Puts new tapes in place of those of the same functions. False, and nothing is done, if they
  /// need more than a plan of the old ones computes. Not while a run is under way.
  bool replace(std::span<const Trace> traces);

 private:
  Declarations& declared() { return const_cast<Declarations&>(declarations()); }
  void fix_shapes(const SurveyedBlock& block);
  void put(const Slot& slot);
  void put_ode(const Slot& slot);
  void put_output(const Slot& slot);
  void put_relation(const Slot& slot);
  void put_relations(const Slot& slot, OutputDeclaration& output);
  void put_time_event(const Slot& slot);
  void narrow_inputs(ZeroCrossing& crossing, int index);
  std::vector<int> inputs_of(const Slot& slot) const;
  std::optional<Slot> slot_of(Role role, int index) const;
  VectorFunction taped(const Slot& slot) const;
  bool fits(const Trace& old, const Trace& now) const;

  const PythonLeaf& original_;
  std::vector<Slot> slots_;
};

}  // namespace saltus::python
