// Refinement: leaves get other functions while their plan is made.
#pragma once

#include <memory>

#include "saltus/plan/plan.hpp"

namespace saltus {

/// A pass of compile() that may give a leaf other functions for the same declarations, for example
/// the tapes of its Python functions. It returns a changed copy of `leaf.declarations()`, or null
/// for a leaf that stays unchanged. States, parameters, ports and events have to stay; functions,
/// the values that they read, and relations may differ.
class Refinement {
 public:
  virtual ~Refinement() = default;

  /// compile() asks this for every leaf, before it computes anything from the declarations.
  virtual std::shared_ptr<const Declarations> before(const LeafSystem& leaf) = 0;
  /// compile() asks this for the leaves that `before` left unchanged. By then the system has a
  /// sound plan of its own declarations, in which the shape of every signal is known.
  virtual std::shared_ptr<const Declarations> with_shapes(const Plan& plan,
                                                          const PlanLeaf& leaf) = 0;
};

}  // namespace saltus
