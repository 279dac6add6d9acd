// Tangents: their begin and the steps.
#include "saltus/simulation/detail/tangents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {

namespace {

/// One step solves a full system of five times as many unknowns.
constexpr Index most_states = 200;
/// [eps t] Shorter steps say nothing about the scale of time: a thousandth of a step is then a rounding.
constexpr double least_step = 1e6;

/// The first part of a plan of which no derivative is known, in words; empty if there is none.
std::string obstacle_of(const Plan& plan) {
  if (plan.nx > most_states)
    return text("the system has ", plan.nx, " continuous states, and at most ", most_states,
                " are supported");
  if (!plan.histories.empty())
    return text("block '", plan.leaf(plan.histories.front()).path,
                "' keeps a history of its input, which has no derivative here");
  for (const GuardGroup& group : plan.guards) {
    if (!group.queued) continue;
    const ZeroCrossing& crossing = plan.crossing_of(group);
    if (crossing.delay || crossing.use_values_from_trigger_time.value_or(false))
      return text("the queued zero crossing '", group.name,
                  "' has a delay, or values from its trigger time");
  }
  return {};
}

/// A parameter or a start value by which the run is differentiated.
struct Found {
  std::string name;
  ContextEntry entry;
};

/// The entries of the option `sensitivity`, a vector entry by entry.
std::vector<Found> chosen_entries(const std::vector<std::string>& names, const Layout& layout) {
  std::vector<Found> all;
  for (const std::string& name : names) {
    const ContextEntry entry = find_entry(layout, name);
    if (entry.kind == ContextEntry::Kind::mode)
      throw ModelError(text("option sensitivity: '", name,
                            "' is a mode, an integer, so nothing has a derivative with respect to "
                            "it; expected a parameter or a start value"));
    for (Index i = 0; i < entry.size; ++i)
      all.push_back(
          {entry.size == 1 ? name : text(name, "[", i, "]"), {entry.kind, entry.first + i, 1}});
  }
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto same = [&](const Found& other) {
      return other.entry.kind == one->entry.kind && other.entry.first == one->entry.first;
    };
    if (std::any_of(all.begin(), one, same))
      throw ModelError(text("option sensitivity: '", one->name, "' is named twice"));
  }
  return all;
}

}  // namespace

Tangents::Tangents(const Machine& machine, const GuardSet& guards, const SimulatorOptions& options,
                   Results& results)
    : machine_(&machine),
      guards_(&guards),
      options_(&options),
      results_(&results),
      probe_(machine),
      flow_(machine, probe_),
      jumps_(flow_, probe_),
      times_(machine, guards, options, flow_, probe_) {
  const std::string obstacle = obstacle_of(machine.plan());
  if (!obstacle.empty())
    throw ModelError(text("option sensitivity: ", obstacle,
                          "; take differences of two runs for this system instead"));
}

void Tangents::require_fits(const Context& start) const {
  chosen_entries(options_->sensitivity, start.layout());
}

void Tangents::renew() {
  Sensitivities& out = results_->sensitivities;
  const std::vector<std::string> names = std::move(out.parameters);
  out = {};
  out.parameters = names;
  out.signals.resize(machine_->plan().taps.size());
}

void Tangents::begin(const Context& start) {
  using Kind = ContextEntry::Kind;
  const std::vector<Found> all = chosen_entries(options_->sensitivity, start.layout());
  const auto m = static_cast<Index>(all.size());
  const Plan& plan = machine_->plan();
  results_->sensitivities.parameters.clear();
  columns_.x.setZero(plan.nx, m), columns_.z.setZero(plan.nz, m), columns_.y.setZero(plan.ny, m);
  columns_.parameters.assign(all.size(), -1);
  Eigen::MatrixXd atol(plan.nx, m);
  for (Index k = 0; k < m; ++k) {
    const auto& [kind, i, one] = nth(all, k).entry;
    if (kind == Kind::parameter) nth(columns_.parameters, k) = i;
    if (kind == Kind::continuous_state) columns_.x(i, k) = 1.0;
    if (kind == Kind::discrete_state) columns_.z(i, k) = 1.0;
    results_->sensitivities.parameters.push_back(nth(all, k).name);
    // As in CVODES: the tolerance of a state, in units of the parameter.
    const double value = kind == Kind::parameter          ? start.parameters()[i]
                         : kind == Kind::continuous_state ? start.continuous_state()[i]
                                                          : start.discrete_state()[i];
    for (Index j = 0; j < plan.nx; ++j)
      atol(j, k) = options_->atol[j] / (value == 0.0 ? 1.0 : std::abs(value));
  }
  renew();
  variation_.emplace(Variation::Tolerances{options_->rtol.smallest(), std::move(atol)});
  columns_.t.setZero(m), lost_.assign(all.size(), 0);
  jumps_.begin(plan.nx);
  monitors_.clear(), predicted_.clear();
  one_sided_.begin();
  t_ = start.time(), in_instant_ = false;
  probe_.begin(), probe_.note(machine_->x.data(), 0.0);
  begin_signals(start);
}

/// The constant outputs follow the parameters, and the held ones the states too.
void Tangents::begin_signals(const Context& start) {
  for (Index k = 0; k < size(); ++k) {
    const Index parameter = nth(columns_.parameters, k);
    if (parameter < 0) continue;
    const auto read = [&](Machine& probe, double shift, double* out) {
      ContextValues values = start.values();
      values.parameters[parameter] += shift;
      values.continuation = nullptr, values.pending = nullptr;
      probe.load(start.with_values(values));
      std::copy_n(probe.y.data(), probe.y.size(), out);
    };
    probe_.derivative(machine_->x.data(), {.parameter = parameter}, machine_->y.size(), read,
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
  forget_end();
  t_ = to;
  if (!integration.started() || machine_->plan().nx == 0) return;
  // A step of some roundings of the time was cut by an event, and says nothing about the scale of it.
  const bool cut =
      to - from <= least_step * thresholds::eps * std::max(std::abs(from), std::abs(to));
  probe_.note(integration.state().data(), cut ? 0.0 : to - from);
  Eigen::VectorXd x(machine_->plan().nx);
  const auto equation = [&](double t, Eigen::MatrixXd& a, Eigen::MatrixXd& b) {
    if (t < to)
      integration.interpolate(t, x.data());
    else
      x = integration.state();
    flow_.at(t, x.data(), columns_, a, b);
  };
  const double joint = integration.joint(from);
  const double middle = from < joint && joint < to ? joint : from;
  variation_->advance(from, middle, equation, columns_.x);
  variation_->advance(middle, to, equation, columns_.x);
  lose_not_finite("");
  look_for_jump(from, to, [&](double t) {
    if (t < to)
      integration.interpolate(t, x.data());
    else
      x = integration.state();
    return x;
  });
}

}  // namespace saltus
