// What a relation at zero decides, by the flow and the guards with its other truth.
#include "saltus/simulation/detail/other_truth.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

namespace {

/// Two flows are the same if they differ by no more than this part.
constexpr double same_flow = 1e-9;
/// [of the state] A shift that shows a bend of the flow by 1e-6 of it, far above its rounding.
constexpr double bend_shift = 1e-6;
/// Two slopes of the flow are the same if they differ by no more than this part.
constexpr double same_slope = 1e-3;

}  // namespace

bool OtherTruth::decides(const GuardGroup& group, Index entry, double t,
                         const Eigen::VectorXd& flow) {
  const auto watched = [&](const EdgeWatch& edge) {
    return std::ranges::find(edge.relations, group.index) != edge.relations.end();
  };
  if (std::ranges::any_of(machine_->plan().edges, watched)) return true;
  if (flow.size() == 0) return false;
  const Eigen::VectorXd other = flow_with(group, entry, true, t, 0, 0.0);
  return !((other - flow).cwiseAbs().maxCoeff() <= same_flow * flow.cwiseAbs().maxCoeff());
}

bool OtherTruth::bends(const GuardGroup& group, Index entry, double t, Index k) {
  const double length = columns_->x.col(k).cwiseAbs().maxCoeff();
  const double shift =
      bend_shift * (1.0 + machine_->x.cwiseAbs().maxCoeff()) / std::max(length, 1.0);
  const auto flow = [&](bool other, double at) { return flow_with(group, entry, other, t, k, at); };
  const Eigen::VectorXd here = flow(false, 0.0), as_held = flow(false, shift),
                        other = flow(true, shift);
  for (Index i = 0; i < here.size(); ++i) {
    const double moved = std::abs(as_held[i] - here[i]) + std::abs(other[i] - here[i]);
    const double apart = std::abs(other[i] - as_held[i]);
    if (apart > same_slope * moved && apart > same_flow * std::abs(here[i])) return true;
  }
  return false;
}

/// The flow at a state that is moved along a column, where the truth of a relation is as it is held, or
/// the other one.
Eigen::VectorXd OtherTruth::flow_with(const GuardGroup& group, Index entry, bool other, double t,
                                      Index k, double shift) {
  Machine& probe = probe_->at(machine_->x.data(), columns_->column(k), shift);
  double& truth = probe.truth_at(group.index, entry);
  const double before = truth;
  if (other) truth = truth == 0.0 ? 1.0 : 0.0;
  probe.evaluate_instant(t + shift * columns_->t[k]);
  Eigen::VectorXd flow(machine_->plan().nx);
  probe.derivative(t + shift * columns_->t[k], probe.x.data(), flow.data());
  truth = before;
  probe.evaluate_instant(t);
  for (Index i = 0; i < flow.size(); ++i)
    if (machine_->resting().rests(i)) flow[i] = 0.0;
  return flow;
}

}  // namespace saltus
