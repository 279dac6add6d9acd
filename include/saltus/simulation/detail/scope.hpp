// Scope: the guards and watched edges that an instant belongs to.
#pragma once

#include <cstddef>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// The guards and edges that the parts of an instant go through, by number and in the order of the
/// plan. Today this is the whole scene. An instant of a part of the scene needs another scope only:
/// no part of an instant goes through the lists of the plan itself.
struct Scope {
  /// The whole scene.
  explicit Scope(const Plan& plan);

  std::vector<std::size_t> crossings = {};  ///< the guards of zero crossings
  std::vector<std::size_t> relations = {};  ///< the guards of relations and of opaque booleans
  std::vector<std::size_t> edges = {};      ///< the watched edges
  /// Of each edge of the plan: the guards of the relations that decide it.
  List<std::vector<std::size_t>> deciders = {};
  /// Of each guard of the plan that is of a relation: the edges that it decides.
  List<std::vector<std::size_t>> decided = {};
};

}  // namespace saltus
