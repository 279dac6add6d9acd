// The Python blocks of a system, the shapes of their ports, and the traces of their functions.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "plan_tapes.hpp"
#include "python_leaf.hpp"
#include "saltus/plan/plan.hpp"
#include "shared_outside.hpp"
#include "trace.hpp"

namespace saltus::python {

/// One Python block of a system.
struct BlockTraces {
  const PythonLeaf* leaf;
  std::string path;
  std::size_t declared;  // the number of its declarations when it was traced
  std::vector<Shape> inputs = {}, outputs = {};  // unknown before it is traced
  bool traced = false;
  std::vector<Trace> traces = {};  // of the functions that have one
  SharedOutside shared = {};

  void take_shapes(const Plan& plan, const PlanLeaf& where);
  /// Guesses the shapes of a system that cannot run yet. Open inputs count as their ports say, or
  /// as single numbers.
  void guess_shapes();
};

/// It refers to the blocks of the system and keeps none alive, because the Python object of the
/// system owns this object.
class Traces {
 public:
  explicit Traces(const System& system);

  /// Whether some block has declared more since, or the value of an open input was fixed.
  bool stale() const;
  bool complete() const;
  void guess_shapes();
  void set(std::size_t number, std::vector<Trace> traces);
  void share(std::size_t number, std::vector<int> readers, std::vector<int> writers);

  std::vector<BlockTraces>& blocks() { return blocks_; }
  /// The counts of the instructions that the runs of the system have interpreted.
  const std::shared_ptr<Interpreted>& interpreted() const { return interpreted_; }
  std::optional<std::size_t> number_of(const LeafSystem& leaf) const;

 private:
  std::vector<BlockTraces> blocks_;
  std::unordered_map<const LeafSystem*, std::size_t> numbers_;
  int fixes_ = System::fixes();
  std::shared_ptr<Interpreted> interpreted_ = std::make_shared<Interpreted>();
};

}  // namespace saltus::python
