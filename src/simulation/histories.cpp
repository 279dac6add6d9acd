// Histories: the inputs of a step, for the leaves that keep them.
#include "saltus/simulation/detail/histories.hpp"

#include <utility>

namespace saltus {

Histories::Histories(Machine& machine, const SimulatorOptions& options)
    : machine_(&machine), rtol_(options.rtol.smallest()), atol_(options.atol.smallest()) {
  for (const int leaf : machine.plan().histories) {
    for (const History& history : machine.plan().leaf(leaf).declared().histories)
      longest_step_ = std::min(longest_step_, history.longest_step);
  }
}

void Histories::add(double from, double to, Integration& integration) {
  if (!(to > from)) return;
  for (const int leaf : machine_->plan().histories) append(leaf, from, to, integration);
  changed_ = continues_ = false;
}

void Histories::append(int number, double from, double to, Integration& integration) {
  const PlanLeaf& leaf = machine_->plan().leaf(number);
  for (const History& history : leaf.declared().histories) {
    const Place& place = leaf.input_places[history.input];
    const std::function<void(double, std::span<double>)> input = [&](double t,
                                                                     std::span<double> u) {
      const bool inside = integration.started() && t < to;
      const double* x = (inside ? integration.at(t) : integration.state()).data();
      const Values values = machine_->evaluate_histories(t, x);
      std::copy_n(values(place), place.size, u.data());
      if (!VectorView(u.data(), place.size).allFinite()) {
        throw SimulationError(
            text("t = ", t, " s: input ", history.input, " of block '", leaf.path,
                 "', of which it keeps a history, is not finite (NaN or Inf); check it there"),
            t, leaf.path);
      }
    };
    history.append({from, to, changed_, rtol_, atol_, input, continues_},
                   VectorRef(machine_->z.data() + leaf.z, leaf.nz));
  }
}

}  // namespace saltus
