// LadderSystem: a system as it runs, its Python blocks replaced by what tracing made of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ladder_leaf.hpp"

namespace saltus::python {

/// Same blocks, wires, names and contexts as the system it was made of, which has to live as long.
class LadderSystem final : public System {
 public:
  /// `traces` are those of the blocks of the survey, in its order.
  LadderSystem(const Survey& survey, const std::vector<std::vector<Trace>>& traces);

  std::vector<std::string> input_names() const override { return original_.input_names(); }
  std::vector<std::string> output_names() const override { return original_.output_names(); }
  void collect(Structure& out, const std::string& path) const override;
  LeafPort output_source(int index) const override {
    return replaced(original_.output_source(index));
  }
  LeafPort input_target(int index) const override {
    return replaced(original_.input_target(index));
  }

  /// The same port of the system as it runs.
  OutputPort port(const OutputPort& original) const;

  /// As LadderLeaf::replace, of all blocks. False if some do not fit; the run then has to begin
  /// anew.
  bool replace(const std::vector<std::vector<Trace>>& traces);

 private:
  LeafPort replaced(LeafPort port) const;
  const LeafSystem* replaced(const LeafSystem* leaf) const;

  const System& original_;
  std::vector<const LeafSystem*> originals_;  // sorted
  std::vector<const LeafSystem*> runs_;       // for each of them
  std::vector<std::unique_ptr<LadderLeaf>> leaves_;
};

}  // namespace saltus::python
