// TracePass: the pass of compile() in which Python blocks get the tapes of their functions.
#pragma once

#include <memory>
#include <vector>

#include "saltus/plan/refinement.hpp"
#include "traced_declarations.hpp"

namespace saltus::python {

/// A pass serves one plan at a time. Blocks that were traced for an earlier plan keep the shapes
/// they had there, so that none of their functions is called to find them.
class TracePass final : public Refinement {
 public:
  /// `trace_block(number, block)` is called for each block that is not traced yet, under the lock
  /// of the interpreter; it returns the traces.
  TracePass(std::shared_ptr<Traces> traces, py::object trace_block)
      : traces_(std::move(traces)), trace_block_(std::move(trace_block)) {}

  std::shared_ptr<const Declarations> before(const LeafSystem& leaf) override;
  std::shared_ptr<const Declarations> with_shapes(const Plan& plan, const PlanLeaf& leaf) override;
  /// A pass that needs no interpreter, with a copy of the traces. All blocks are traced.
  std::shared_ptr<TracePass> of_known() const {
    return std::make_shared<TracePass>(std::make_shared<Traces>(*traces_), py::object());
  }
  /// Releases the Python function, because the plan is made.
  void end() { trace_block_ = {}; }

  /// Replaces the tapes in the plan by the present ones. Returns false if some need more than the
  /// plan computes: the run then has to begin anew. It must not be called during a run.
  bool replace();

 private:
  std::shared_ptr<const Declarations> declarations_of(std::size_t number);

  std::shared_ptr<Traces> traces_;
  std::vector<std::vector<Slot>> slots_;  // of each block
  std::vector<SharedOutside> shared_;     // of each block, when the plan was made
  py::object trace_block_;
};

/// The counts of the instructions that the runs of a system have interpreted, which its `callbacks`
/// keep; new counts if None.
std::shared_ptr<Interpreted> interpreted_by(const py::object& callbacks);

/// The pass for the object `callbacks` of python/saltus/callbacks/. Null, which leaves the system
/// as it declares itself, if that is None or there is no Python block.
std::shared_ptr<TracePass> trace_pass(const py::object& callbacks);

}  // namespace saltus::python
