// The names of the rows and columns of a linearisation.
#include "linear_names.hpp"

#include "saltus/base/error.hpp"

namespace saltus {

void add_entries(std::vector<std::string>& names, const std::string& name, const Shape& shape) {
  for (Index i = 0; i < shape.size; ++i) names.push_back(name + entry_place(shape, i));
}

std::string prefix_of(const Plan& plan, const PlanLeaf& leaf) {
  return plan.leaves.size() == 1 ? "" : leaf.path + ".";
}

std::vector<std::string> state_names(const Plan& plan) {
  std::vector<std::string> names;
  for (const PlanLeaf& leaf : plan.leaves) {
    const std::string prefix = prefix_of(plan, leaf);
    const auto& own = leaf.declared().continuous.names;
    for (Index i = 0; i < leaf.nx; ++i)
      names.push_back(own.empty() ? text(prefix, "x[", i, "]") : text(prefix, nth(own, i)));
  }
  return names;
}

}  // namespace saltus
