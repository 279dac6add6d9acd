// Wiring errors: the messages about wires that `build` and a plan share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "saltus/base/ids.hpp"
#include "saltus/base/model_errors.hpp"
#include "saltus/model/shape.hpp"

namespace saltus::detail {

/// Refuses a loop of outputs. Each output in the list reads the next.
[[noreturn]] inline void throw_algebraic_loop(const std::vector<std::string>& loop) {
  // The list runs from a reader to its source; the signal flows the other way round.
  std::string message = "algebraic loop: each output depends on the next at the same time\n";
  for (const std::string& output : loop) message += text("  '", output, "' reads\n");
  message += text("  '", loop.front(),
                  "'\nput a block without feedthrough into the loop (Integrator, UnitDelay), or "
                  "declare which inputs an output does not read");
  throw AlgebraicLoopError(message);
}

/// Refuses a source of an input that expects another shape.
[[noreturn]] inline void throw_wrong_shape(std::string_view input, std::string_view block,
                                           const Shape& expected, const Shape& found,
                                           std::string_view source) {
  const bool flatten = found.is_matrix() && expected == Shape::of(found.size);
  throw ShapeMismatchError(text("input '", input, "' of block '", block, "': expected ",
                                in_words(expected), ", found ", in_words(found), " from ", source,
                                flatten ? "; a Multiplexer of one input gives the entries of a "
                                          "matrix as a vector, row by row"
                                        : ""));
}

}  // namespace saltus::detail
