// The balanced companion realisation of a transfer function.
#include "saltus/library/detail/realisation.hpp"

#include <cmath>
#include <string_view>

namespace saltus::detail {

namespace {

Eigen::VectorXd without_leading_zeros(const Eigen::VectorXd& coefficients) {
  Index zeros = 0;
  while (zeros < coefficients.size() && coefficients[zeros] == 0.0) ++zeros;
  return coefficients.tail(coefficients.size() - zeros);
}

/// [A B; C 0] of the controllable companion form.
Eigen::MatrixXd companion(const Polynomials& p) {
  const Index n = p.order();
  const Eigen::VectorXd a = p.denominator / p.denominator[0];
  const Eigen::VectorXd b = padded_numerator(p) / p.denominator[0];
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (Index i = 0; i + 1 < n; ++i) system(i, i + 1) = 1.0;
  for (Index j = 0; j < n; ++j) {
    system(n - 1, j) = -a[n - j];
    system(n, j) = b[n - j] - b[0] * a[n - j];
  }
  if (n > 0) system(n - 1, n) = 1.0;
  return system;
}

/// The nearest power of two to the root of a ratio.
double power_of_two(double ratio) { return std::exp2(std::round(0.5 * std::log2(ratio))); }

}  // namespace

Polynomials proper(const std::string& block, const char* variable, const Eigen::VectorXd& numerator,
                   const Eigen::VectorXd& denominator) {
  const Polynomials p{without_leading_zeros(numerator), without_leading_zeros(denominator)};
  insist(p.denominator.size() > 0, block,
         "the denominator is 0; expected a coefficient that is not");
  insist(p.numerator.size() > 0, block, "the numerator is 0; expected a coefficient that is not");
  insist(p.numerator.size() <= p.denominator.size(), block, "the numerator has the degree ",
         p.numerator.size() - 1, " in ", variable, ", the denominator ", p.order(),
         "; expected a proper transfer function: multiply the denominator by ",
         std::string_view(variable) == "s" ? "a fast pole" : "a power of z, which delays y");
  return p;
}

Eigen::VectorXd padded_numerator(const Polynomials& p) {
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(p.denominator.size());
  padded.tail(p.numerator.size()) = p.numerator;
  return padded;
}

Eigen::VectorXd balance(const Polynomials& p) {
  const Index size = p.order() + 1;
  Eigen::MatrixXd system = companion(p);
  system.diagonal().setZero();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(size);
  bool changed = true;
  constexpr int most_sweeps = 100;  // it converges in a few; a bound in place of a proof
  for (int sweep = 0; sweep < most_sweeps && changed; ++sweep) {
    changed = false;
    for (Index i = 0; i < size; ++i) {
      const double row = system.row(i).norm(), column = system.col(i).norm();
      const double factor = row > 0.0 && column > 0.0 ? power_of_two(row / column) : 1.0;
      if (factor == 1.0) continue;
      changed = true;
      scale[i] *= factor;
      system.row(i) /= factor;
      system.col(i) *= factor;
    }
  }
  return scale.head(size - 1) / scale[size - 1];
}

}  // namespace saltus::detail
