// The columns with which a run begins, by the names of the option.
#include "saltus/simulation/detail/tangent_start.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "sensitivity_entries.hpp"

namespace saltus {

namespace {

using Kind = ContextEntry::Kind;

std::shared_ptr<const ParameterMoves> moves_of(const std::vector<ParameterDirection>& directions,
                                               Index np) {
  auto all = std::make_shared<ParameterMoves>(np);
  for (Index k = 0; k < std::ssize(directions); ++k) all->add(k, nth(directions, k).moves);
  return all;
}

/// The value of a parameter, or of a state at the start.
double value_of(const ContextEntry& entry, const Context& start) {
  if (entry.kind == Kind::parameter) return start.parameters()[entry.first];
  return entry.kind == Kind::continuous_state ? start.continuous_state()[entry.first]
                                              : start.discrete_state()[entry.first];
}

}  // namespace

TangentStart::TangentStart(const Plan& plan, const SimulatorOptions& options)
    : plan_(&plan), options_(&options), computed_(plan.computed) {
  require_sensitivities(plan);
}

void TangentStart::require_fits(const Context& start) const {
  chosen_entries(options_->sensitivity, start.layout());
}

TangentStart::Begun TangentStart::begin(const Context& start, TangentColumns& columns) {
  const std::vector<SensitivityEntry> all = chosen_entries(options_->sensitivity, start.layout());
  const auto m = static_cast<Index>(all.size());
  columns.x.setZero(plan_->nx, m), columns.z.setZero(plan_->nz, m), columns.y.setZero(plan_->ny, m);
  columns.t.setZero(m);
  std::vector<ParameterDirection> directions = directions_of(all, start);
  columns.p = moves_of(directions, plan_->np);
  Begun begun{.tolerances = {options_->rtol.smallest(), atol_of(all, start)},
              .state_atol = state_atol()};
  for (Index k = 0; k < m; ++k) {
    const ContextEntry& entry = nth(all, k).entry;
    if (entry.kind == Kind::continuous_state) columns.x(entry.first, k) = 1.0;
    if (entry.kind == Kind::discrete_state) columns.z(entry.first, k) = 1.0;
    begun.names.push_back(nth(all, k).name);
    begun.obstacles.push_back(std::move(nth(directions, k).obstacle));
  }
  return begun;
}

Eigen::VectorXd TangentStart::state_atol() const {
  Eigen::VectorXd atol(plan_->nx);
  for (Index j = 0; j < plan_->nx; ++j) atol[j] = options_->atol[j];
  return atol;
}

/// As in CVODES: the tolerance of a state, in units of the parameter.
Eigen::MatrixXd TangentStart::atol_of(const std::vector<SensitivityEntry>& all,
                                      const Context& start) const {
  Eigen::MatrixXd atol(plan_->nx, std::ssize(all));
  for (Index k = 0; k < std::ssize(all); ++k) {
    const double value = value_of(nth(all, k).entry, start);
    for (Index j = 0; j < plan_->nx; ++j)
      atol(j, k) = options_->atol[j] / (value == 0.0 ? 1.0 : std::abs(value));
  }
  return atol;
}

/// How the parameters of all blocks move with each column, at the values of the start.
std::vector<ParameterDirection> TangentStart::directions_of(
    const std::vector<SensitivityEntry>& all, const Context& start) {
  std::vector<ParameterDirection> directions;
  for (const SensitivityEntry& one : all) {
    const bool parameter = one.entry.kind == Kind::parameter;
    directions.push_back(parameter ? computed_.by(one.entry.first, start.parameters())
                                   : ParameterDirection());
  }
  return directions;
}

}  // namespace saltus
