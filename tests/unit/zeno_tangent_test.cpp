// ZenoTangent: against differences of the sums of a ZenoMonitor.
#include "saltus/simulation/detail/zeno_tangent.hpp"

#include <cmath>

#include "saltus/simulation/detail/zeno.hpp"
#include "support/catch.hpp"

using namespace saltus;

namespace {

/// A series of firings whose gaps shrink by q: t_k = (1 - q^k) / (1 - q), and a state q^k after them.
double time_of(int k, double q) { return (1.0 - std::pow(q, k)) / (1.0 - q); }
double time_by_q(int k, double q) {
  return (-k * std::pow(q, k - 1) * (1.0 - q) + 1.0 - std::pow(q, k)) / ((1.0 - q) * (1.0 - q));
}

}  // namespace

TEST_CASE("the accumulation of a geometric series has its derivative", "[zeno][tangent]") {
  for (const double q : {0.3, 0.9}) {  // the ratio of the last gaps, and that of gaps further apart
    ZenoTangent zeno;
    Eigen::VectorXd state(1);
    Eigen::MatrixXd slope(1, 1);
    for (int k = 10; k < 14; ++k) {
      zeno.fired(time_of(k, q), Eigen::RowVectorXd::Constant(1, time_by_q(k, q)));
      state[0] = std::pow(q, k), slope(0, 0) = k * std::pow(q, k - 1);
      if (k < 13) zeno.remember(state, slope);
    }
    // The sum is 1 / (1 - q). The gaps have lost four digits to the times.
    CHECK(std::abs(zeno.accumulation_time()[0] * (1.0 - q) * (1.0 - q) - 1.0) < 1e-8);
    // The states accumulate at 0 for every q.
    CHECK(std::abs(zeno.accumulate(state, slope)(0, 0)) < 1e-8);
  }
}

TEST_CASE("sums of firings before the run have no derivative", "[zeno][tangent]") {
  for (const double q : {0.3, 0.95}) {  // the sum of the last three firings, and of the last four
    ZenoTangent zeno;
    const int needed = q > thresholds::slow_series ? 4 : 3;
    for (int k = 10; k < 10 + needed; ++k) {
      CHECK_FALSE(zeno.knows());
      zeno.remember(Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1));
      zeno.fired(time_of(k, q), Eigen::RowVectorXd::Zero(1));
    }
    CHECK(zeno.knows());
  }
}
