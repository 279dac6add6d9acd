#include "ladder_system.hpp"

#include <algorithm>

namespace saltus::python {

LadderSystem::LadderSystem(const Survey& survey, const std::vector<std::vector<Trace>>& traces)
    : System(survey.system->name()), original_(*survey.system) {
  std::vector<std::pair<const LeafSystem*, const LeafSystem*>> pairs;
  for (std::size_t i = 0; i < survey.blocks.size(); ++i) {
    leaves_.push_back(std::make_unique<LadderLeaf>(survey.blocks[i], traces[i]));
    pairs.emplace_back(survey.blocks[i].leaf, leaves_.back().get());
  }
  std::ranges::sort(pairs);
  for (const auto& [original, run] : pairs) originals_.push_back(original), runs_.push_back(run);
}

const LeafSystem* LadderSystem::replaced(const LeafSystem* leaf) const {
  const auto found = std::ranges::lower_bound(originals_, leaf);
  if (found == originals_.end() || *found != leaf) return leaf;
  return runs_[static_cast<std::size_t>(found - originals_.begin())];
}

LeafPort LadderSystem::replaced(LeafPort port) const { return {replaced(port.leaf), port.index}; }

void LadderSystem::collect(Structure& out, const std::string& path) const {
  const std::size_t leaves = out.leaves.size(), wires = out.wires.size();
  original_.collect(out, path);
  for (std::size_t i = leaves; i < out.leaves.size(); ++i)
    out.leaves[i].system = replaced(out.leaves[i].system);
  for (std::size_t i = wires; i < out.wires.size(); ++i) {
    out.wires[i] = {replaced(out.wires[i].from), replaced(out.wires[i].to)};
  }
}

OutputPort LadderSystem::port(const OutputPort& original) const {
  if (original.system == nullptr) return original;
  const LeafPort source = original.system->output_source(original.index);
  const LeafSystem* run = replaced(source.leaf);
  return run == source.leaf ? original : OutputPort{run, source.index};
}

bool LadderSystem::replace(const std::vector<std::vector<Trace>>& traces) {
  bool all = true;
  for (std::size_t i = 0; i < leaves_.size(); ++i) all = leaves_[i]->replace(traces[i]) && all;
  return all;
}

}  // namespace saltus::python
