// FlowJumps: whether the derivative of a scene jumps along a step, without an event.
#include "saltus/simulation/detail/flow_jumps.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

namespace {

/// The part of f by which it may differ from the sum of its derivatives along a piece of a step. A
/// smooth f misses by the cube of the length of the piece, so halvings bring it below soon; a jump
/// stays as large as it is.
constexpr double jump_share = 1e-3;
/// The rounding of f, in parts of its terms.
constexpr double rate_rounding = 1e3 * thresholds::eps;
/// Down to neighbouring numbers.
constexpr int most_bisections = 60;

}  // namespace

bool FlowJumps::within(double from, double to, const StateAt& state,
                       const TangentColumns& columns) {
  double jump = jump_of(from, to, state, columns);
  for (int i = 0; jump > jump_share; ++i) {
    const double middle = from + 0.5 * (to - from);
    if (i == most_bisections || !(from < middle && middle < to)) return true;
    const double first = jump_of(from, middle, state, columns),
                 second = jump_of(middle, to, state, columns);
    (first > second ? to : from) = middle;
    jump = std::max(first, second);
  }
  return false;
}

/// By how much f changes between the two states beyond A dx, in parts of its size. The time is the same
/// on both sides, so a jump in time does not count; the mean of both times leaves an error of third
/// order.
double FlowJumps::jump_of(double from, double to, const StateAt& state,
                          const TangentColumns& columns) {
  const Eigen::VectorXd low = state(from), high = state(to), middle = state(0.5 * (from + to));
  Eigen::MatrixXd a, b;
  flow_->at(0.5 * (from + to), middle.data(), columns, a, b);
  // Where differences find no derivative, as at a kink, f itself has to change little.
  for (Index i = 0; i < a.rows(); ++i)
    if (!a.row(i).allFinite()) a.row(i).setZero();
  const Eigen::VectorXd f[] = {probe_->flow(from, low.data()), probe_->flow(from, high.data()),
                               probe_->flow(to, low.data()), probe_->flow(to, high.data())};
  const Eigen::VectorXd miss = 0.5 * (f[1] - f[0] + f[3] - f[2]) - a * (high - low);
  const Eigen::VectorXd noise = rate_rounding * (a.cwiseAbs() * high.cwiseAbs());
  double most = 0.0;
  for (Index i = 0; i < miss.size(); ++i) {
    for (const Eigen::VectorXd& each : f) rates_[i] = std::max(rates_[i], std::abs(each[i]));
    const double beyond = std::abs(miss[i]) - noise[i];
    if (beyond > 0.0) most = std::max(most, beyond / rates_[i]);
  }
  return most;
}

}  // namespace saltus
