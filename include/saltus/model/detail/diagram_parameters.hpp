// DiagramParameters: the parameters of a diagram, as a block without ports.
#pragma once

#include <string>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

/// Holds their values in a context. Its path is the path of the diagram.
class DiagramParameters final : public LeafSystem {
 public:
  explicit DiagramParameters(std::string name) : LeafSystem(std::move(name)) {}
  using LeafSystem::declare_dynamic_parameter;
  std::string kind() const override { return "parameters"; }
};

}  // namespace saltus
