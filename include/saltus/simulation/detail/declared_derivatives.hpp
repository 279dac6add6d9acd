// Declared derivatives: those that a leaf writes by itself, asked for and checked.
#pragma once

#include <string>

#include "saltus/plan/detail/machine.hpp"

namespace saltus {

/// A row for each of `rows` numbers of a function of a leaf, with the columns of Derivatives. Throws
/// SimulationError, which names the block, the time and the entry, for a number that is not finite.
/// `what`: "the derivative of block 'ball'".
Eigen::MatrixXd declared_derivatives(const PlanLeaf& leaf, const DerivativesFunction& function,
                                     const At& at, Index rows, const std::string& what);

/// The name of a column of Derivatives: "x[0]", "e", "input 1[2]", "time".
std::string name_of_column(const PlanLeaf& leaf, Index column);

/// Calls use(column, place) for each column of Derivatives, but that of the time: the place of the
/// value by which it is.
template <class Use>
void each_column(const PlanLeaf& leaf, const Use& use) {
  Index column = 0;
  const auto add = [&](const Place& place) {
    for (Index i = 0; i < place.size; ++i) use(column++, Place(place.space, place.offset + i, 1));
  };
  add({Space::x, leaf.x, leaf.nx}), add({Space::z, leaf.z, leaf.nz}),
      add({Space::p, leaf.p, leaf.np});
  for (const Place& place : leaf.input_places) add(place);
}

}  // namespace saltus
