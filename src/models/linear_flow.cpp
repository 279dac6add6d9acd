#include "saltus/models/linear_flow.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace saltus::models {

namespace {

/// Positions of the eigenvalues by size, the largest first.
std::vector<Index> by_size(const Eigen::EigenSolver<LinearFlow::Matrix>& eigen) {
  std::vector<Index> order(static_cast<std::size_t>(eigen.eigenvalues().size()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Index>(k);
  std::ranges::sort(order, [&](Index a, Index b) {
    return std::abs(eigen.eigenvalues()[a]) > std::abs(eigen.eigenvalues()[b]);
  });
  return order;
}

}  // namespace

LinearFlow::LinearFlow(const Matrix& a, const Vector& b) {
  const Index n = a.rows();
  const Matrix inverse = a.inverse();
  rest_ = -(inverse * b), rates_.resize(n), modes_.resize(n, n);
  const Eigen::EigenSolver<Matrix> fast(a), slow(inverse);
  const std::vector<Index> first = by_size(fast), last = by_size(slow);
  const auto rate = [&](std::size_t k) { return fast.eigenvalues()[first[k]]; };
  const Real middle = std::sqrt(std::abs(rate(0)) * std::abs(rate(first.size() - 1)));
  for (std::size_t k = 0; k < first.size(); ++k) {
    const auto at = static_cast<Index>(k);
    const Index other = last[first.size() - 1 - k];
    const bool is_fast = std::abs(rate(k)) > middle;
    rates_[at] = is_fast ? rate(k) : Real(1) / slow.eigenvalues()[other];
    modes_.col(at) = is_fast ? fast.eigenvectors().col(first[k]) : slow.eigenvectors().col(other);
  }
  into_modes_ = modes_.inverse();
}

LinearFlow::Vector LinearFlow::at(Real duration, const Vector& from) const {
  Eigen::Vector<Complex, Eigen::Dynamic> part = into_modes_ * (from - rest_).cast<Complex>();
  for (Index k = 0; k < part.size(); ++k) part[k] *= std::exp(rates_[k] * duration);
  return rest_ + (modes_ * part).real();
}

}  // namespace saltus::models
