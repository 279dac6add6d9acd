// Ports: a place to connect, with a shape and the values that an output reads.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saltus/base/callback.hpp"
#include "saltus/base/list.hpp"
#include "saltus/base/reads.hpp"
#include "saltus/base/view.hpp"
#include "saltus/model/formula.hpp"

namespace saltus {

class LeafSystem;
class System;

/// Size of a signal. A scalar remains a scalar in the results, a vector of one entry remains a
/// vector.
struct Shape {
  Index size = 1;
  bool vector = false;
  bool operator==(const Shape&) const = default;

  static constexpr Shape scalar() { return {1, false}; }
  static constexpr Shape of(Index n) { return {n, true}; }
};

/// Computes the shape of an output from the shapes of all inputs, if it is not fixed.
using ShapeRule = std::function<Shape(std::span<const Shape>)>;

/// The shape of an elementwise block, such as Gain, Adder and Abs: a scalar is stretched to the
/// width of the others.
inline Shape elementwise(std::span<const Shape> inputs) {
  Shape result = Shape::scalar();
  for (const Shape& shape : inputs) {
    if (shape.vector && (!result.vector || result.size == 1)) result = shape;
  }
  return result;
}

/// Entries first to last - 1 of a signal.
struct EntryRange {
  Index first = 0, last = 0;
};

/// The entries of input k that entry i of an output, or of a derivative, reads; `widths` has the
/// widths of all inputs. The rule may name too many entries, never too few: a stiff method assumes
/// zero in its Jacobian for the others. Without a rule all entries count.
using EntryRule = std::function<EntryRange(Index i, int k, std::span<const Index> widths)>;

/// Entry i reads entry i of each input, or the only entry of a scalar input: Gain, Adder, Abs.
inline EntryRange entry_by_entry(Index i, int k, std::span<const Index> widths) {
  return nth(widths, k) == 1 ? EntryRange{0, 1} : EntryRange{i, i + 1};
}

struct InputDeclaration {
  std::string name = {};
  std::optional<Shape> shape = {};  ///< empty: the shape of the connected output
};

struct OutputDeclaration {
  std::string name = {};
  VectorFunction calc = {};  ///< empty for a formula and for a view of a state or of parameters
  std::optional<Shape> shape = Shape::scalar();
  ShapeRule shape_rule = {};  ///< decides if `shape` is empty
  Reads reads = Reads::everything;
  /// Feedthrough: the inputs it reads; all if not given.
  std::optional<std::vector<int>> inputs = {};
  bool boolean = false;  ///< 0 or 1; located by bisection and held if it reaches a derivative
  /// It is the control signal of a part and nothing else: inside a part that is not executed it is
  /// false.
  bool controls_only = false;
  std::optional<Place> view = {};  ///< a state or parameter shown directly, never copied
  EntryRule entries = {};          ///< the entries of the inputs that each of its entries reads
  Formula formula = {};            ///< in place of calc: a plan may fuse it
  /// A block behind the output, such as a RateTransition: what reads or records the output reads
  /// that of this block. It has one input and one output, of this output's shape, and is known as
  /// "block.output".
  std::shared_ptr<const LeafSystem> sampler = {};
};

/// An output port of a system, to connect or to record.
struct OutputPort {
  const System* system = nullptr;
  int index = 0;
};

/// An input port of a system.
struct InputPort {
  const System* system = nullptr;
  int index = 0;
};

}  // namespace saltus
