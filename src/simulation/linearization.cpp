// Linearization: its poles, and how it was found.
#include <algorithm>
#include <utility>

#include "saltus/base/detail/eigenvalues.hpp"
#include "saltus/simulation/linearize.hpp"

namespace saltus {

Eigen::VectorXcd Linearization::poles() const {
  if (A.rows() == 0) return {};
  Eigen::VectorXcd poles = detail::eigenvalues(A);
  std::sort(poles.begin(), poles.end(), [](const auto& a, const auto& b) {
    return std::pair(a.real(), a.imag()) < std::pair(b.real(), b.imag());
  });
  return poles;
}

std::string Linearization::method() const {
  if (differences.empty()) return "exact";
  std::string all;
  for (const std::string& one : differences) all += (all.empty() ? "" : ", ") + one;
  return text("central differences of ", all);
}

}  // namespace saltus
