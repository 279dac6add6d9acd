// Arguments: the views, made once.
#include "saltus/plan/detail/arguments.hpp"

namespace saltus {

Arguments::Arguments(Memory& memory)
    : memory_(&memory),
      bases_{memory.x.data(), memory.z.data(), memory.p.data(), memory.y.data()},
      place_of_z_{Space::z, 0, memory.plan().nz} {
  const Plan& plan = memory.plan();
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const int node : leaf.relations) relation_values_.push_back(memory.signal(node));
  }
  const double* const* relations = relation_values_.data();
  for (const PlanLeaf& leaf : plan.leaves) {
    const Inputs inputs(leaf.input_places.data(), static_cast<int>(leaf.input_places.size()),
                        &bases_);
    views_.push_back(At(0.0, {memory.x.data() + leaf.x, leaf.nx},
                        {memory.z.data() + leaf.z, leaf.nz}, {memory.p.data() + leaf.p, leaf.np}, 0,
                        inputs, relations));
    relations += leaf.relations.size();
  }
  views_.push_back(At(0.0, {memory.x.data(), plan.nx}, {memory.y.data(), plan.ny},
                      {memory.p.data(), plan.np}, 0, Inputs(&place_of_z_, 1, &bases_), nullptr));
}

}  // namespace saltus
