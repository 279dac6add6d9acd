// Tangents: guards that wait at zero at the end of an instant.
#include <algorithm>
#include <cmath>
#include <optional>

#include "saltus/simulation/detail/tangents.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

/// A slope, or a column, of a guard that is smaller than this part of its terms is zero: those of
/// called functions are differences with errors of 1e-10 (see TangentProbe), which terms that cancel
/// amplify.
constexpr double zero_part = 1e-6;
/// Two flows are the same if they differ by no more than this part.
constexpr double same_flow = 1e-9;
/// [of the state] A shift that shows a bend of the flow by 1e-6 of it, far above its rounding.
constexpr double bend_shift = 1e-6;
/// Two slopes of the flow are the same if they differ by no more than this part.
constexpr double same_slope = 1e-3;

/// The rounding of a guard's value, in parts of its terms and of their movement in a rounding of time.
constexpr double guard_rounding = 1e3 * thresholds::eps;
/// [of the largest value of a guard in the run] A guard that is farther from zero is not beside an
/// event: its rounding is far below, unless its terms cancel to a billionth.
constexpr double beside_event = 1e-9;

/// A parameter may move a state behind so many integrators.
constexpr int derivatives_ahead = 4;

/// Whether a guard that moves from zero with this slope would fire if it came from the other side.
bool fires_along(Direction direction, double slope) {
  return slope < 0.0 ? fires(direction, 1, -1) : fires(direction, -1, 1);
}

}  // namespace

/// A guard may wait at exactly zero where a run began or where a write has put it, and the flow take it
/// on in its firing direction. It does not fire then. For a parameter that moves it to the side from
/// which it comes there is an event, and for the other sign there is none.
void Tangents::look_at_waiting() {
  const auto waits = [this](std::size_t k) {
    const Guard& guard = (*guards_)[k];
    return guard.phase == saltus::Phase::waiting && std::abs(guards_->g[k]) <= guard.error;
  };
  const std::vector<std::size_t>& active = guards_->active().all;
  if (std::ranges::none_of(active, waits)) return;
  const Eigen::VectorXd flow = probe_.flow(t_, machine_->x.data());
  for (const std::size_t k : active)
    if (waits(k) && !(*guards_)[k].monitor) look_at_waiting(k, flow);
}

/// A flow with a kink has no derivative for a state that rests at it, as x' = -|x| at x = 0. A state that
/// goes through it has one.
void Tangents::look_at_kinks() {
  const double* x = machine_->x.data();
  if (!flow_.rests_at_switch(t_, x, probe_.flow(t_, x))) return;
  Eigen::MatrixXd a, b;
  flow_.at(t_, x, columns_, a, b);
  for (Index k = 0; k < size(); ++k)
    if (!gaps_.lost(k) && bends_soon(k, a, b))
      lose(k, "", "the flow has a kink, at which the state rests");
}

/// Whether a column leads off the kink, now or as the derivatives of S = A S + b lead it on.
bool Tangents::bends_soon(Index k, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const double* x = machine_->x.data();
  TangentDirection along = columns_.column(k);
  along.t = 0.0;
  if (flow_.bends(t_, x, along)) return true;
  Eigen::VectorXd later = a * columns_.x.col(k) + b.col(k);
  for (int i = 0; i < derivatives_ahead && !later.isZero(0.0); ++i) {
    if (flow_.bends(t_, x, {.x = later.data()})) return true;
    later = a * later;
  }
  return false;
}

double Tangents::rounding_of(const GuardTangent& guard, const Eigen::VectorXd& flow) const {
  return guard_rounding *
         guard.by_state.cwiseAbs().dot(machine_->x.cwiseAbs() + std::abs(t_) * flow.cwiseAbs());
}

/// A guard may be about to fire, within the rounding of its value, where a time event or a delivery
/// happens. It would fire at this time too: the order of both is that of their roundings.
void Tangents::look_beside(const Present& present, const TangentColumns& until,
                           const Eigen::VectorXd& flow, bool first) {
  if (guards_->active().all.empty()) return;
  Machine& probe = probe_.at(machine_->x.data());
  Eigen::VectorXd g(machine_->plan().look_slots);
  probe.guards_at(t_, probe.x.data(), g.data());
  for (const std::size_t k : guards_->active().all) {
    const Guard& guard = (*guards_)[k];
    const auto slot = static_cast<Index>(k);
    guard_sizes_[slot] = std::max(guard_sizes_[slot], std::abs(g[slot]));
    const bool may_fire =
        !first && present.firings.empty() && !guard.monitor && guard.phase == saltus::Phase::armed;
    if (may_fire && std::abs(g[slot]) <= beside_event * guard_sizes_[slot])
      look_beside(k, g[slot], until, flow);
  }
}

void Tangents::look_beside(std::size_t number, double g, const TangentColumns& until,
                           const Eigen::VectorXd& flow) {
  const GuardGroup& group = machine_->plan().guard((*guards_)[number].group);
  if (!group.is_crossing() || group.is_opaque()) return;
  const auto slot = static_cast<Index>(number);
  const double* x = machine_->x.data();
  const GuardTangent guard = flow_.guard(t_, x, slot, until);
  const double slope = guard.by_state.dot(flow) + guard.by_time;
  const bool nears =
      fires((*guards_)[number].direction, (*guards_)[number].side, slope < 0.0 ? -1 : 1);
  if (nears && std::abs(g) <= rounding_of(guard, flow))
    merge(times_.of_crossing(slot, group.name, t_, x, until), false);
}

void Tangents::look_at_waiting(std::size_t number, const Eigen::VectorXd& flow) {
  const Guard& record = (*guards_)[number];
  const GuardGroup& group = machine_->plan().guard(record.group);
  if (group.is_opaque() || record.rests) return;
  const GuardTangent guard =
      flow_.guard(t_, machine_->x.data(), static_cast<Index>(number), columns_);
  const double slope = guard.by_state.dot(flow) + guard.by_time;
  const double terms = guard.by_state.cwiseAbs().dot(flow.cwiseAbs()) + std::abs(guard.by_time);
  const bool rests = !(std::abs(slope) > zero_part * terms);
  if (group.is_crossing() && (rests || !fires_along(record.direction, slope))) return;
  std::optional<bool> turns;  // whether the truth decides; the same for all columns
  for (Index k = 0; k < size(); ++k) {
    const double all = guard.by_state.cwiseAbs().dot(columns_.x.col(k).cwiseAbs()) +
                       terms * std::abs(columns_.t[k]);  // they cancel at the guard's own root
    if (!(std::abs(guard.columns[k]) > zero_part * all)) continue;
    if (!turns) turns = group.is_crossing() || decides(group, record.entry, flow);
    if (!*turns && !(rests && bends(group, record.entry, k))) continue;
    lose(k, group.name,
         rests ? "the relation rests at its root"
               : "the guard is at zero, and the flow takes it across");
  }
}

/// Whether a relation decides more than a kink of the flow: the flow itself, or an edge.
bool Tangents::decides(const GuardGroup& group, Index entry, const Eigen::VectorXd& flow) {
  const auto watched = [&](const EdgeWatch& edge) {
    return std::ranges::find(edge.relations, group.index) != edge.relations.end();
  };
  if (std::ranges::any_of(machine_->plan().edges, watched)) return true;
  if (flow.size() == 0) return false;
  const Eigen::VectorXd other = flow_with_truth(group, entry, true, 0, 0.0);
  return !((other - flow).cwiseAbs().maxCoeff() <= same_flow * flow.cwiseAbs().maxCoeff());
}

/// Whether the flow beside a relation at rest depends on its truth in first order, along a column: the
/// kink of an Abs of a state that rests at zero.
bool Tangents::bends(const GuardGroup& group, Index entry, Index k) {
  const double length = columns_.x.col(k).cwiseAbs().maxCoeff();
  const double shift =
      bend_shift * (1.0 + machine_->x.cwiseAbs().maxCoeff()) / std::max(length, 1.0);
  const auto flow = [&](bool other, double at) {
    return flow_with_truth(group, entry, other, k, at);
  };
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
Eigen::VectorXd Tangents::flow_with_truth(const GuardGroup& group, Index entry, bool other, Index k,
                                          double shift) {
  Machine& probe = probe_.at(machine_->x.data(), columns_.column(k), shift);
  double& truth = probe.truth_at(group.index, entry);
  const double before = truth;
  if (other) truth = truth == 0.0 ? 1.0 : 0.0;
  probe.evaluate_instant(t_ + shift * columns_.t[k]);
  Eigen::VectorXd flow(machine_->plan().nx);
  probe.derivative(t_ + shift * columns_.t[k], probe.x.data(), flow.data());
  truth = before;
  probe.evaluate_instant(t_);
  for (Index i = 0; i < flow.size(); ++i)
    if (machine_->resting().rests(i)) flow[i] = 0.0;
  return flow;
}

}  // namespace saltus
