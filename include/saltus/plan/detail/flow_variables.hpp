// FlowVariables: the values of the variables of a FlowGraph.
#pragma once

#include <vector>

#include "saltus/plan/detail/machine.hpp"

namespace saltus {

/// Shows a machine as the expressions of its FlowGraph read it.
class FlowVariables {
 public:
  explicit FlowVariables(const Machine& machine)
      : machine_(&machine),
        modes_(machine.modes.size()),
        places_{Place{Space::z, 0, machine.plan().nz},
                Place{Space::y, 0, static_cast<Index>(modes_.size())}} {}
  FlowVariables(const FlowVariables&) = delete;  // views point into it
  FlowVariables& operator=(const FlowVariables&) = delete;

  /// Calls `use` with the arguments at time t [s] and state x.
  template <class Use>
  void at(double t, const double* x, const Use& use) {
    const Machine& m = *machine_;
    for (std::size_t i = 0; i < modes_.size(); ++i) modes_[i] = m.modes[i];
    const Bases bases{x, m.z.data(), m.p.data(), modes_.data()};
    use(At(t, {x, m.plan().nx}, {m.y.data(), m.y.size()}, {m.p.data(), m.p.size()}, 0,
           Inputs(places_, 2, &bases), nullptr));
  }

 private:
  const Machine* machine_;
  std::vector<double> modes_;
  Place places_[2];
};

}  // namespace saltus
