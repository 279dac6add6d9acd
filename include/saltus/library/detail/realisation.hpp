// The balanced companion realisation of a transfer function.
#pragma once

#include <string>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// The coefficients of a transfer function, the highest power of s first, without leading zeros.
struct Polynomials {
  Eigen::VectorXd numerator, denominator;

  /// The degree of the denominator: the number of states.
  Index order() const { return denominator.size() - 1; }
  /// Whether the degrees are equal, so that the input reaches the output at once.
  bool feedthrough() const { return numerator.size() == denominator.size(); }
};

/// Throws ModelError if a polynomial has no coefficient that is not 0, or if the degree of the
/// numerator is higher. `variable` is "s" or "z", for the message.
Polynomials proper(const std::string& block, const char* variable, const Eigen::VectorXd& numerator,
                   const Eigen::VectorXd& denominator);

/// Powers of two by which the states of the controllable companion form are divided, so that the
/// rows and columns of [A B; C 0] have norms of one size: E. E. Osborne, "On pre-conditioning of
/// matrices", J. ACM 7 (1960) 338. A power of two rounds nothing.
Eigen::VectorXd balance(const Polynomials& polynomials);

/// The numerator over the order of the denominator, padded with zeros in front: as many
/// coefficients as the denominator has.
Eigen::VectorXd padded_numerator(const Polynomials& polynomials);

}  // namespace saltus::detail
