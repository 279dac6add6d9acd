// S along a step: through its stages, or by collocation.
#include "saltus/simulation/detail/step_tangents.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saltus {

namespace {

/// [eps t] Shorter steps say nothing about the scale of time: a thousandth of a step is then a rounding.
constexpr double least_step = 1e6;

}  // namespace

void StepTangents::begin(Variation::Tolerances tolerances, Eigen::VectorXd state_atol) {
  stages_.begin(tolerances, std::move(state_atol)), variation_.emplace(std::move(tolerances));
  jumps_.begin(machine_->plan().nx), called_jumps_.begin(machine_->plan().nx);
}

void StepTangents::advance(double from, double to, Integration& integration,
                           TangentColumns& columns) {
  variation_->forget();
  to_ = to;
  if (integration.started() && machine_->plan().nx > 0) solve(from, to, integration, columns);
}

/// Carries the columns along the step: through the stages of the solver, or by the linear equation.
void StepTangents::solve(double from, double to, Integration& integration,
                         TangentColumns& columns) {
  // A step of some roundings of the time was cut by an event, and says nothing about the scale of it.
  const bool cut =
      to - from <= least_step * thresholds::eps * std::max(std::abs(from), std::abs(to));
  probe_->note(integration.state().data(), cut ? 0.0 : to - from);
  const bool by_stages = stages_.advance(from, to, integration, columns);
  if (by_stages && !stages_.crossed_switch()) return;
  if (flow_->exact() && switches_->any()) {
    Eigen::MatrixXd end = columns.x;
    if (by_stages) columns.x = stages_.last().s0();
    if (solve_across_jumps(from, to, integration, columns)) return;
    columns.x = std::move(end);
  }
  flow_->forget_obstacle();
  if (!by_stages) {
    collocate(from, to, integration, columns, columns.x);
    gaps_->lose_not_finite(to, flow_->obstacle());
  }
  look_for_jump(from, to, integration, columns);
}

/// Where the flow jumps in the step, the columns are carried from jump to jump. False if it does not,
/// and nothing has changed then.
bool StepTangents::solve_across_jumps(double from, double to, Integration& integration,
                                      TangentColumns& columns) {
  const auto state = [&](double t) { return state_at(t, integration); };
  const std::vector<FlowSwitches::Change> changes = switches_->changes(from, to, state);
  const auto is_jump = [&](const auto& one) { return switches_->is_jump(one, state); };
  if (std::ranges::none_of(changes, is_jump)) return false;
  stages_.forget();
  double since = from;
  for (const FlowSwitches::Change& one : changes) {
    if (!is_jump(one)) continue;
    carry(since, one.before, integration, columns);
    add(switches_->jump(one, state, columns), one.after, columns);
    since = one.after;
  }
  carry(since, to, integration, columns);
  gaps_->lose_not_finite(to, {});
  if (changes.size() < thresholds::most_changes) return true;
  for (Index k = 0; k < columns.size(); ++k)
    if (columns.matters(k)) gaps_->lose(to, k, "", "the flow jumps too often in one step");
  return true;
}

/// Carries the columns on by the linear equation, also over no time.
void StepTangents::carry(double from, double to, Integration& integration,
                         TangentColumns& columns) {
  if (from < to)
    collocate(from, to, integration, columns, columns.x);
  else
    variation_->keep({to, to, {columns.x}});
}

/// A jump goes through all columns that move it.
void StepTangents::add(const FlowJump& jump, double t, TangentColumns& columns) {
  for (Index k = 0; k < columns.size(); ++k) {
    if (gaps_->lost(k) || jump.dtau[k] == 0.0) continue;
    if (std::isnan(jump.dtau[k]))
      gaps_->lose(t, k, "", jump.obstacle);
    else
      columns.x.col(k) += jump.by * jump.dtau[k];
  }
}

/// The state within the last step, whose end is that of the solver.
Eigen::VectorXd StepTangents::state_at(double t, Integration& integration) const {
  Eigen::VectorXd x = integration.state();
  if (t < to_) integration.interpolate(t, x.data());
  return x;
}

/// Solves the linear equation along the step. `s` may be that of the columns.
void StepTangents::collocate(double from, double to, Integration& integration,
                             const TangentColumns& columns, Eigen::MatrixXd& s) {
  Eigen::VectorXd x(machine_->plan().nx);
  const auto equation = [&](double t, Eigen::MatrixXd& a, Eigen::MatrixXd& b) {
    x = integration.state();
    if (t < to_) integration.interpolate(t, x.data());
    flow_->at(t, x.data(), columns, a, b);
  };
  const double joint = integration.joint(from);
  const double middle = from < joint && joint < to ? joint : from;
  variation_->advance(from, middle, equation, s);
  variation_->advance(middle, to, equation, s);
}

/// Where the solver has the stages of the step no more, the linear equation has the values in between.
void StepTangents::need_inside(const TangentColumns& columns) {
  if (!variation_->pieces().empty()) return;
  if (auto piece = stages_.last().piece()) return variation_->keep(std::move(*piece));
  Eigen::MatrixXd s = stages_.last().s0();
  collocate(stages_.last().from(), to_, stages_.last().integration(), columns, s);
}

void StepTangents::inside(double t, TangentColumns& at) {
  if (variation_->pieces().empty() && stages_.last().is_there()) {
    if (stages_.last().at(t, at.x)) return;
    need_inside(at);
  }
  variation_->at(t, at.x);
}

/// f may jump without an event: a branch that no guard announces. A jump at a state would go through all
/// columns, and one at a time through those that move it; the linear equation does not have it.
void StepTangents::look_for_jump(double from, double to, Integration& integration,
                                 const TangentColumns& columns) {
  const auto state = [&](double t) { return state_at(t, integration); };
  const bool everywhere = jumps_.within(from, to, state, columns);
  std::vector<TimeJumps::Jump> jumps;
  if (!everywhere && !flow_->exact()) jumps = called_jumps_.within(from, to, state);
  for (Index k = 0; k < columns.size(); ++k) {
    const auto moves = [&](const auto& one) { return called_jumps_.moves(one, columns, k); };
    if (gaps_->lost(k) || !columns.matters(k)) continue;
    if (everywhere || std::ranges::any_of(jumps, moves))
      gaps_->lose(
          to, k, "",
          "the flow jumps without an event; write the branch as a relation, or as modes with "
          "a guard");
  }
}

}  // namespace saltus
