// The declarations of a Python block as it runs: with tapes in place of the functions that have
// one.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "traces.hpp"

namespace saltus::python {

/// A copy of the declarations of the block, in which the traces in `slots` run in place of their
/// functions. `outputs` are the shapes of the outputs: no function is called again to find them.
std::shared_ptr<const Declarations> traced_declarations(const PythonLeaf& leaf,
                                                        const std::vector<Shape>& outputs,
                                                        const std::vector<Slot>& slots,
                                                        const SharedOutside& shared);

/// Puts traces of the same functions into the slots. Returns false, and does nothing, if they need
/// more than a plan of the old traces computes. It must not be called during a run.
bool replace_traces(const PythonLeaf& leaf, const std::vector<Slot>& slots,
                    std::span<const Trace> traces);

}  // namespace saltus::python
