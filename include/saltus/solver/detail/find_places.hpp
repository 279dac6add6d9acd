// Finds which arguments the values of a function read, by calls of the function.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

/// Moves these arguments together; changed[i] becomes 1 if value i changes, otherwise 0.
using Response = std::function<void(std::span<const int> moved, std::vector<char>& changed)>;

/// Why a search ended.
enum class Search {
  found,
  full,  ///< more than half of all places of 64 groups, as far as it got
  dear   ///< the next round would take more than 2000 calls: some value reads nearly everything
};

struct Places {
  Search search = Search::found;
  Sparsity places = {};  ///< column j: the values that read argument j; empty unless found
  int calls = 0;         ///< of `response`
};

/// Finds the places of n values of n arguments. Arguments are moved in groups that are halved from
/// round to round. Groups that no value reads together are moved in one call (J. Gillis, M. Diehl,
/// "Hierarchical seeding for efficient sparsity pattern recovery in automatic differentiation", 6th
/// SIAM Workshop on Combinatorial Scientific Computing, 2014): 2 c calls a round with c colours,
/// about 2 c log2(n) in all, 6 log2(n) for a tridiagonal matrix, 2 n where one value reads
/// everything.
Places find_places(Index n, const Response& response);

}  // namespace saltus
