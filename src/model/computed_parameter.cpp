// ComputedParameter: found by the blocks of a structure, and computed.
#include "saltus/model/computed_parameter.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

namespace {

/// The path of a leaf and the place of its parameters among those of all leaves.
struct Known {
  const std::string* path;
  Index p;
};

std::unordered_map<const LeafSystem*, Known> known_leaves(const Structure& structure) {
  std::unordered_map<const LeafSystem*, Known> known;
  Index p = 0;
  for (const Structure::Leaf& leaf : structure.leaves) {
    known.emplace(leaf.system, Known{&leaf.path, p});
    p += leaf.system->declarations().parameter_values.size();
  }
  return known;
}

}  // namespace

void ComputedParameters::compute(Eigen::VectorXd& p) const {
  for (const ComputedParameter& one : all) {
    one.values.evaluate(at_parameters(p.data() + one.from, one.count), p.data() + one.to);
    detail::require_finite(p.segment(one.to, one.size),
                           text("parameter '", one.name, "', which the diagram computes"));
  }
}

std::shared_ptr<const ComputedParameters> computed_parameters(const Structure& structure) {
  if (structure.computed.empty()) return {};
  const auto known = known_leaves(structure);
  auto found = std::make_shared<ComputedParameters>();
  for (const Structure::Computed& one : structure.computed) {
    const Known& to = known.at(one.leaf);
    const Layout::Parameter& parameter = *std::ranges::find(
        one.leaf->declarations().parameters, one.parameter, &Layout::Parameter::name);
    found->all.push_back({.name = joined_name(*to.path, one.parameter),
                          .to = to.p + parameter.offset,
                          .size = parameter.size,
                          .from = known.at(one.from).p,
                          .count = one.from->declarations().parameter_values.size(),
                          .values = *one.values});
  }
  return found;
}

}  // namespace saltus
