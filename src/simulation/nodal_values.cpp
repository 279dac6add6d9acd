// NodalValues: the Chebyshev points, and the barycentric formula.
#include "saltus/simulation/detail/nodal_values.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "saltus/tape/series.hpp"

namespace saltus {

namespace {

/// The Chebyshev points of the second kind on [0, 1], including both ends, for each degree up to
/// the highest order of a Taylor series.
constexpr int highest_degree = tape::Series::highest_order;
using Nodes = std::array<std::array<double, highest_degree + 1>, highest_degree + 1>;

const Nodes& nodes() {
  static const Nodes all = [] {
    Nodes made{};
    for (int degree = 1; degree <= highest_degree; ++degree) {
      for (int k = 0; k <= degree; ++k) {
        const double s = std::sin(0.5 * std::numbers::pi * k / degree);
        nth(nth(made, degree), k) = k == degree ? 1.0 : s * s;
      }
    }
    return made;
  }();
  return all;
}

}  // namespace

double NodalValues::node(int k, int degree) { return nth(nodes()[degree], k); }

std::size_t NodalValues::put(const Eigen::VectorXd& x) {
  values_.insert(values_.end(), x.begin(), x.end());
  return values_.size() - static_cast<std::size_t>(x.size());
}

std::size_t NodalValues::add(int degree) {
  const std::size_t first = values_.size();
  values_.resize(place(first, degree + 1));
  return first;
}

/// The second barycentric form, applied to differences from the first value: a constant state is
/// constant to the last bit.
void NodalValues::polynomial(std::size_t first, int d, double s, double* x) const {
  using Row = Eigen::Map<const Eigen::VectorXd>;
  const auto value = [&](int k) { return Row(values_.data() + first + k * size_, size_); };
  Eigen::Map<Eigen::VectorXd> out(x, size_);
  for (int k = 0; k <= d; ++k) {
    if (s != node(k, d)) continue;
    out = value(k);
    return;
  }
  out.setZero();
  double weights = 0.0;
  for (int k = 0; k <= d; ++k) {
    const double end = k == 0 || k == d ? 0.5 : 1.0;
    const double weight = (k % 2 == 0 ? end : -end) / (s - node(k, d));
    weights += weight;
    if (k > 0) out += weight * (value(k) - value(0));
  }
  out = value(0) + out / weights;
}

}  // namespace saltus
