// Tangents: their begin and the steps.
#include "saltus/simulation/detail/tangents.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sensitivity_entries.hpp"

namespace saltus {

namespace {

/// [eps t] Shorter steps say nothing about the scale of time: a thousandth of a step is then a rounding.
constexpr double least_step = 1e6;

std::shared_ptr<const ParameterMoves> moves_of(const std::vector<ParameterDirection>& directions,
                                               Index np) {
  auto all = std::make_shared<ParameterMoves>(np);
  for (Index k = 0; k < std::ssize(directions); ++k) all->add(k, nth(directions, k).moves);
  return all;
}

}  // namespace

Tangents::Tangents(const Machine& machine, const GuardSet& guards, const SimulatorOptions& options,
                   Results& results)
    : machine_(&machine),
      guards_(&guards),
      options_(&options),
      results_(&results),
      computed_(machine.plan().computed),
      probe_(machine),
      flow_(machine, probe_),
      jumps_(flow_, probe_),
      times_(machine, guards, options, flow_, probe_),
      stages_(machine, flow_),
      gaps_(columns_, results),
      events_(columns_, gaps_, results),
      rows_(machine, options, probe_, gaps_, results) {
  require_sensitivities(machine.plan());
}

void Tangents::require_fits(const Context& start) const {
  chosen_entries(options_->sensitivity, start.layout());
}

void Tangents::begin(const Context& start) {
  using Kind = ContextEntry::Kind;
  const std::vector<SensitivityEntry> all = chosen_entries(options_->sensitivity, start.layout());
  const auto m = static_cast<Index>(all.size());
  const Plan& plan = machine_->plan();
  std::vector<std::string> names;
  columns_.x.setZero(plan.nx, m), columns_.z.setZero(plan.nz, m), columns_.y.setZero(plan.ny, m);
  const std::vector<ParameterDirection> directions = directions_of(all, start);
  columns_.p = moves_of(directions, plan.np);
  flow_.begin(*columns_.p);
  Eigen::MatrixXd atol(plan.nx, m);
  for (Index k = 0; k < m; ++k) {
    const Kind kind = nth(all, k).entry.kind;
    const Index i = nth(all, k).entry.first;
    if (kind == Kind::continuous_state) columns_.x(i, k) = 1.0;
    if (kind == Kind::discrete_state) columns_.z(i, k) = 1.0;
    names.push_back(nth(all, k).name);
    // As in CVODES: the tolerance of a state, in units of the parameter.
    const double value = kind == Kind::parameter          ? start.parameters()[i]
                         : kind == Kind::continuous_state ? start.continuous_state()[i]
                                                          : start.discrete_state()[i];
    for (Index j = 0; j < plan.nx; ++j)
      atol(j, k) = options_->atol[j] / (value == 0.0 ? 1.0 : std::abs(value));
  }
  rows_.begin(std::move(names));
  const Variation::Tolerances tolerances{options_->rtol.smallest(), std::move(atol)};
  Eigen::VectorXd state_atol(plan.nx);
  for (Index j = 0; j < plan.nx; ++j) state_atol[j] = options_->atol[j];
  stages_.begin(tolerances, std::move(state_atol)), variation_.emplace(tolerances);
  columns_.t.setZero(m);
  waits_.begin(m), guard_sizes_.setZero(machine_->plan().look_slots);
  jumps_.begin(plan.nx), gaps_.begin(), events_.begin(), one_sided_.begin();
  t_ = start.time(), phase_ = Phase::between;
  probe_.begin(), probe_.note(machine_->x.data(), 0.0);
  begin_signals(start.with_computed(plan.computed));
  for (Index k = 0; k < m; ++k)
    if (const std::string& why = nth(directions, k).obstacle; !why.empty()) lose(k, "", why);
  look_at_kinks();
  open_trajectory();
}

void Tangents::renew() {
  rows_.renew();
  if (variation_) open_trajectory();
}

void Tangents::open_trajectory() {
  if (options_->dense_output)
    results_->sensitivities.trajectory.open(t_, columns_, machine_->resting(), probe_.sizes());
}

/// How the parameters of all blocks move with each column, at the values of the start.
std::vector<ParameterDirection> Tangents::directions_of(const std::vector<SensitivityEntry>& all,
                                                        const Context& start) {
  std::vector<ParameterDirection> directions;
  for (const SensitivityEntry& one : all) {
    const bool parameter = one.entry.kind == ContextEntry::Kind::parameter;
    directions.push_back(parameter ? computed_.by(one.entry.first, start.parameters())
                                   : ParameterDirection());
  }
  return directions;
}

/// The constant outputs follow the parameters, and the held ones the states too.
void Tangents::begin_signals(const Context& start) {
  for (Index k = 0; k < size(); ++k) {
    const std::span<const ParameterMove> moves = columns_.moves(k);
    if (moves.empty()) continue;
    const auto read = [&](Machine& probe, double shift, double* out) {
      ContextValues values = start.values();
      for (const ParameterMove& move : moves) values.parameters[move.entry] += shift * move.by;
      values.continuation = nullptr, values.pending = nullptr;
      probe.load(start.with_values(values));
      std::copy_n(probe.y.data(), probe.y.size(), out);
    };
    probe_.derivative(machine_->x.data(), {.p = moves}, machine_->y.size(), read,
                      columns_.y.col(k).data());
  }
  clear_truths();
  evaluated();
}

/// Truths are held between instants, and their changes are events.
void Tangents::clear_truths() {
  for (const Node& node : machine_->plan().nodes) {
    if ((node.relation || node.boolean) && node.place.space == Space::y && !node.view)
      columns_.y.middleRows(node.place.offset, node.place.size).setZero();
  }
}

void Tangents::step(double from, double to, Integration& integration) {
  variation_->forget();
  gaps_.forget_end();
  t_ = to;
  if (integration.started() && machine_->plan().nx > 0) solve(from, to, integration);
  if (!options_->dense_output) return;
  if (stages_.has_step()) need_inside();
  results_->sensitivities.trajectory.add(from, to, variation_->pieces(), columns_,
                                         machine_->resting(), probe_.sizes());
}

/// Carries the columns along the step: through the stages of the solver, or by the linear equation.
void Tangents::solve(double from, double to, Integration& integration) {
  // A step of some roundings of the time was cut by an event, and says nothing about the scale of it.
  const bool cut =
      to - from <= least_step * thresholds::eps * std::max(std::abs(from), std::abs(to));
  probe_.note(integration.state().data(), cut ? 0.0 : to - from);
  const bool by_stages = stages_.advance(from, to, integration, columns_);
  if (by_stages && !stages_.crossed_switch()) return;
  flow_.forget_obstacle();
  if (!by_stages) {
    collocate(from, to, integration, columns_.x);
    gaps_.lose_not_finite(t_, flow_.obstacle());
  }
  look_for_jump(from, to, [&](double t) {
    Eigen::VectorXd x = integration.state();
    if (t < to) integration.interpolate(t, x.data());
    return x;
  });
}

/// Solves the linear equation along the step.
void Tangents::collocate(double from, double to, Integration& integration, Eigen::MatrixXd& s) {
  Eigen::VectorXd x(machine_->plan().nx);
  const auto equation = [&](double t, Eigen::MatrixXd& a, Eigen::MatrixXd& b) {
    x = integration.state();
    if (t < to) integration.interpolate(t, x.data());
    flow_.at(t, x.data(), columns_, a, b);
  };
  const double joint = integration.joint(from);
  const double middle = from < joint && joint < to ? joint : from;
  variation_->advance(from, middle, equation, s);
  variation_->advance(middle, to, equation, s);
}

/// Where the solver has the stages of the step no more, the linear equation has the values in between.
void Tangents::need_inside() {
  if (!variation_->pieces().empty()) return;
  if (auto piece = stages_.piece()) return variation_->keep(std::move(*piece));
  Eigen::MatrixXd s = stages_.begin_of_step();
  collocate(stages_.from(), t_, stages_.integration(), s);
}

void Tangents::inside(double t, Eigen::MatrixXd& s) {
  if (variation_->pieces().empty() && stages_.has_step()) {
    if (stages_.at(t, s)) return;
    need_inside();
  }
  variation_->at(t, s);
}

/// f may jump where the state is, without an event: a branch that no guard announces. The jump would
/// go through all columns, and the linear equation does not have it.
void Tangents::look_for_jump(double from, double to, const FlowJumps::StateAt& state) {
  if (!jumps_.within(from, to, state, columns_)) return;
  for (Index k = 0; k < size(); ++k) {
    if (columns_.matters(k))
      lose(k, "",
           "the flow jumps without an event; write the branch as a relation, or as modes with a "
           "guard");
  }
}

void Tangents::monitor(const MonitorHit& hit, const double* x) {
  const GuardGroup& group = machine_->plan().guard((*guards_)[hit.firing.guard()].group);
  TangentColumns at = columns_;
  if (hit.t < t_) inside(hit.t, at.x);
  const MovedTime moved =
      group.is_opaque() ? MovedTime{.by = Eigen::RowVectorXd::Constant(size(), TangentGaps::none)}
                        : times_.of_crossing(hit.firing.slot, group.name, hit.t, x, at);
  for (Index k = 0; k < size(); ++k) {
    if (std::isnan(moved.by[k]) && !gaps_.lost(k))
      gaps_.note(hit.t, k, group.name, "the monitor only grazes zero, or shows a sign only");
  }
  events_.add(t_, moved.by, cause_.has_value());
}

void Tangents::record(double t, const double* x) {
  if (phase_ == Phase::opened) return rows_.add(t, x, before_, one_sided_);
  TangentColumns at = columns_;
  if (!in_instant() && t < t_) inside(t, at.x);
  fix_time(probe_, t, x, at);
  if (in_instant()) one_sided_.judge(t, *machine_, columns_, at, cause());  // up to this pass
  rows_.add(t, x, at, one_sided_);
}

void Tangents::finish() {
  events_.finish();
  if (options_->dense_output)
    results_->sensitivities.trajectory.close(t_, columns_, machine_->resting(), probe_.sizes(),
                                             results_->status != Status::failed);
  TangentColumns at = columns_;
  fix_time(probe_, t_, machine_->x.data(), at);
  gaps_.forget_end();
  if (results_->status == Status::reached_end) gaps_.end(one_sided_, t_, at.x, at.z);
  rows_.finish(at);
}

std::string Tangents::describe() const {
  return text("sensitivities: ", options_->sensitivity.size(), " names, ", flow_.describe(), "\n");
}

}  // namespace saltus
