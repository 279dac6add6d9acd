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
#include "saltus/model/shape.hpp"

namespace saltus {

class LeafSystem;
class System;

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
  bool flat = false;  ///< a matrix port that takes a vector of its entries, row by row, too

  bool takes(const Shape& signal) const {
    return !shape || saltus::takes(*shape, signal) ||
           (flat && !signal.is_matrix() && signal.size == shape->size);
  }
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
  DerivativesFunction derivatives = {};  ///< of calc, see ContinuousState::derivatives
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
