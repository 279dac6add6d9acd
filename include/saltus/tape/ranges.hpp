// Ranges: between which bounds expressions are while their variables move between two points.
#pragma once

#include <span>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"
#include "saltus/tape/graph.hpp"
#include "saltus/tape/value_range.hpp"

namespace saltus::tape {

/// Bounds by interval arithmetic: each operation has the least and the greatest value over the bounds of
/// its operands. So they hold the values, up to roundings, and may be wider where a variable is read more
/// than once. An operation of which nothing is known here has no bounds.
class Ranges {
 public:
  /// The part of a graph that `outputs` need.
  Ranges(const Graph& graph, std::span<const Node> outputs);

  /// The place of an output among the bounds.
  int place(std::size_t output) const { return outputs_[output].id; }
  /// Whether some of them reads a continuous state.
  bool reads_state() const { return reads_state_; }
  /// Writes the bounds of all parts, see `place`, while the time [s] goes from that of `from` to `to`, and the
  /// states from those of `from` to x_to. A state may leave the interval between its two values by half
  /// of it on either side. All else is as in `from`.
  void evaluate(const At& from, double to, const double* x_to, List<ValueRange>& bounds) const;

 private:
  Graph graph_;
  std::vector<Node> outputs_;
  bool reads_state_ = false;
};

}  // namespace saltus::tape
