#include "saltus/simulation/detail/zeno_tangent.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

void ZenoTangent::fired(double t, const Eigen::RowVectorXd& dt) {
  std::ranges::rotate(times_, times_.end() - 1);
  std::ranges::rotate(tangents_, tangents_.end() - 1);
  times_[0] = t, tangents_[0] = dt;
  ++count_;
}

bool ZenoTangent::knows() const {
  if (count_ < 3 || after_tangent_.size() == 0) return false;
  return gap(0) / gap(1) <= thresholds::slow_series || count_ >= 4;
}

/// q / (1 - q) as ZenoMonitor::remainder has it, with its derivative dq / (1 - q)^2.
ZenoTangent::Remainder ZenoTangent::remainder() const {
  const auto ratio = [this](std::size_t i) -> Eigen::RowVectorXd {
    return gap_tangent(0) / gap(i) - gap(0) / (gap(i) * gap(i)) * gap_tangent(i);
  };
  double q = gap(0) / gap(1);
  Eigen::RowVectorXd dq;
  if (q > thresholds::slow_series) {
    q = std::sqrt(gap(0) / gap(2));
    dq = ratio(2) / (2.0 * q);
  } else {
    dq = ratio(1);
  }
  return {q / (1.0 - q), dq / ((1.0 - q) * (1.0 - q))};
}

Eigen::RowVectorXd ZenoTangent::accumulation_time() const {
  const auto [value, derivative] = remainder();
  return tangents_[0] + value * gap_tangent(0) + gap(0) * derivative;
}

Eigen::MatrixXd ZenoTangent::accumulate(const Eigen::VectorXd& after,
                                        const Eigen::MatrixXd& derivatives) const {
  const auto [value, derivative] = remainder();
  return derivatives + value * (derivatives - after_tangent_) + (after - after_) * derivative;
}

}  // namespace saltus
