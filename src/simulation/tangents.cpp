// Tangents: their begin and the steps.
#include "saltus/simulation/detail/tangents.hpp"

#include <cmath>
#include <utility>

namespace saltus {

Tangents::Tangents(const Machine& machine, const GuardSet& guards, const SimulatorOptions& options,
                   Results& results)
    : machine_(&machine),
      guards_(&guards),
      start_(machine.plan(), options),
      probe_(machine),
      flow_(machine, probe_),
      times_(machine, guards, options, flow_, probe_),
      gaps_(columns_, results),
      switches_(machine, options, flow_),
      steps_(machine, flow_, probe_, gaps_, switches_),
      time_(columns_, gaps_),
      held_(machine, flow_, probe_),
      pass_(machine, probe_, columns_),
      waiting_(machine, columns_, pass_, gaps_),
      at_zero_(machine, guards, flow_, probe_, columns_, gaps_),
      kinks_(machine, flow_, probe_),
      events_(columns_, gaps_, results),
      rows_(machine, options, probe_, gaps_, results),
      dense_(machine, options, probe_, results) {}

void Tangents::begin(const Context& start) {
  TangentStart::Begun begun = start_.begin(start, columns_);
  flow_.begin(*columns_.p);
  rows_.begin(std::move(begun.names));
  switches_.begin(), steps_.begin(std::move(begun.tolerances), std::move(begun.state_atol));
  waiting_.begin(), at_zero_.begin(), gaps_.begin(), events_.begin(), one_sided_.begin();
  t_ = start.time(), phase_ = Phase::between;
  probe_.begin(), probe_.note(machine_->x.data(), 0.0);
  held_.begin(start.with_computed(machine_->plan().computed), columns_);
  evaluated();
  for (Index k = 0; k < size(); ++k)
    if (const std::string& why = nth(begun.obstacles, k); !why.empty()) gaps_.lose(t_, k, "", why);
  kinks_.look(t_, columns_, gaps_);
  lose_beside_jump(columns_, "", "the run begins at a jump of the flow, which moves");
  dense_.open(t_, columns_);
}

void Tangents::renew() {
  rows_.renew();
  if (steps_.begun()) dense_.open(t_, columns_);
}

void Tangents::step(double from, double to, Integration& integration) {
  gaps_.forget_end();
  t_ = to;
  steps_.advance(from, to, integration, columns_);
  if (dense_.asked()) dense_.add(from, to, steps_.pieces(columns_), columns_);
}

void Tangents::monitor(const MonitorHit& hit, const double* x) {
  const GuardGroup& group = machine_->plan().guard((*guards_)[hit.firing.guard()].group);
  TangentColumns at = columns_;
  if (hit.t < t_) steps_.inside(hit.t, at);
  const MovedTime moved =
      group.is_opaque() ? MovedTime{.by = Eigen::RowVectorXd::Constant(size(), TangentGaps::none)}
                        : times_.of_crossing(hit.firing.slot, group.name, hit.t, x, at);
  for (Index k = 0; k < size(); ++k) {
    if (std::isnan(moved.by[k]) && !gaps_.lost(k))
      gaps_.note(hit.t, k, group.name, "the monitor only grazes zero, or shows a sign only");
  }
  events_.add(t_, moved.by, time_.cause().has_value());
}

void Tangents::record(double t, const double* x) {
  if (phase_ == Phase::opened) return rows_.add(t, x, one_sided_.before(), one_sided_, {});
  const bool in_instant = phase_ != Phase::between;
  TangentColumns at = columns_;
  if (!in_instant && t < t_) steps_.inside(t, at);
  fix_time(probe_, t, x, at);
  if (in_instant) one_sided_.judge(t, *machine_, columns_, at, time_.event());  // up to this pass
  rows_.add(t, x, at, one_sided_, in_instant ? AtJump() : at_jump(t, x, at));
}

void Tangents::finish() {
  events_.finish();
  dense_.close(t_, columns_);
  TangentColumns at = columns_;
  fix_time(probe_, t_, machine_->x.data(), at);
  gaps_.forget_end();
  const AtJump jump = at_jump(t_, machine_->x.data(), at);
  rows_.finish(t_, std::move(at), one_sided_, jump);
}

/// The entries of the state whose derivatives jump at (t, x), where a jump of the flow moves.
AtJump Tangents::at_jump(double t, const double* x, const TangentColumns& at) {
  const std::optional<FlowJump> jump = switches_.beside(t, x, at);
  if (!jump) return {};
  AtJump masks = AtJump::Constant(at.x.rows(), at.size(), false);
  for (Index k = 0; k < at.size(); ++k)
    if (jump->dtau[k] != 0.0) masks.col(k) = jump->by.array() != 0.0;
  return masks;
}

/// The flow jumps at the present time, which some columns move apart from that jump.
void Tangents::lose_beside_jump(const TangentColumns& before, const std::string& event,
                                const std::string& reason) {
  const std::optional<FlowJump> jump = switches_.beside(t_, machine_->x.data(), before);
  if (!jump) return;
  for (Index k = 0; k < size(); ++k) {
    const double moved = before.t[k] + jump->dtau[k];
    if (!gaps_.lost(k) && (std::isnan(moved) || moves_apart(moved, columns_.t[k])))
      gaps_.lose(t_, k, event, reason);
  }
}

std::string Tangents::describe() const {
  return text("sensitivities: ", start_.names(), " names, ", flow_.describe(), "\n");
}

}  // namespace saltus
