// check_derivatives: declared derivatives against central differences.
#pragma once

#include <string>
#include <vector>

#include "saltus/model/context.hpp"
#include "saltus/model/system.hpp"

namespace saltus {

/// A declared derivative that differs from a central difference.
struct WrongDerivative {
  std::string function;   ///< "the derivative of block 'ball'"
  std::string by;         ///< "x[0]", "g", "input 0[2]", "time"
  Index row = 0;          ///< of the numbers of the function; those of a reset map are x+, then z+
  double declared = 0.0;  ///< what the block says
  double difference = 0.0;  ///< NaN where no difference was found
};

/// Compares the derivatives and the Jacobians that the blocks of a system declare with central
/// differences, at the values of a context. An entry is right if it differs from the difference by at
/// most `tolerance` times the largest entry of its row, or the size of its number. An empty result says
/// that all are right there, in the mode of the context. Throws ModelError for a context of another
/// system, and SimulationError for a derivative that is not finite.
std::vector<WrongDerivative> check_derivatives(const System& system, const Context& context,
                                               double tolerance = 1e-6);

}  // namespace saltus
