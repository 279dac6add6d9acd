// Small leaves for tests, which are declared by lambdas at their place of use.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>

#include "saltus/model/diagram_builder.hpp"
#include "support/run.hpp"

namespace support {

inline Eigen::VectorXd vec(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<saltus::Index>(values.size()));
}

/// A leaf whose declarations a test makes itself: `Leaf leaf("name", [](Leaf& l) { l.declare_...;
/// })`.
class Leaf : public saltus::LeafSystem {
 public:
  template <class Declare>
  Leaf(std::string name, Declare declare) : LeafSystem(std::move(name)) {
    declare(*this);
  }
  using LeafSystem::declare_continuous_state;
  using LeafSystem::declare_continuous_state_output;
  using LeafSystem::declare_default_mode;
  using LeafSystem::declare_discrete_state;
  using LeafSystem::declare_discrete_state_output;
  using LeafSystem::declare_dynamic_parameter;
  using LeafSystem::declare_edge_reset;
  using LeafSystem::declare_event_input;
  using LeafSystem::declare_input_port;
  using LeafSystem::declare_jacobian;
  using LeafSystem::declare_jacobian_sparsity;
  using LeafSystem::declare_mode_output;
  using LeafSystem::declare_one_shot;
  using LeafSystem::declare_output_port;
  using LeafSystem::declare_periodic_update;
  using LeafSystem::declare_relation;
  using LeafSystem::declare_shared_outside;
  using LeafSystem::declare_sparse_jacobian;
  using LeafSystem::declare_time_event;
  using LeafSystem::declare_zero_crossing;
};

using saltus::At;
using saltus::Next;
using saltus::VectorRef;

/// A reset that counts in discrete state 0.
inline void count_up(const At& at, Next& next) {
  next.set_discrete_state(at.z + Eigen::VectorXd::Unit(at.z.size(), 0));
}

/// x' = rate, x(0) = start.
inline void declare_ramp(Leaf& leaf, double rate = 1.0, double start = 0.0) {
  leaf.declare_continuous_state(
      {.initial = vec({start}), .ode = [rate](const At&) { return rate; }});
  leaf.declare_continuous_state_output("x");
}

}  // namespace support
