// Tangents: across an instant.
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

const char* const jump_beside_event =
    "the flow jumps at the time of the event, and their order would change";

}  // namespace

/// Opens an instant, whose time moves as its causes do.
void Tangents::open(const Present& present, const std::vector<int>& due,
                    const std::vector<DueNow>& waiting) {
  t_ = present.t, phase_ = Phase::opened;
  const double* x = machine_->x.data();
  // A monitor of the last step may be judged in the instant.
  if (!guards_->monitors.empty()) steps_.keep_inside(columns_);
  TangentColumns before = columns_;
  fix_time(probe_, t_, x, before);
  one_sided_.open(*machine_, std::move(before));
  probe_.note(x, 0.0);
  const Eigen::RowVectorXd until = columns_.t;
  const Eigen::VectorXd f = probe_.flow(t_, x);
  const TangentColumns until_causes = columns_;
  take_causes(present, due, waiting, f);
  lose_beside_jump(until_causes, time_.event(), jump_beside_event);
  columns_.x += f * (columns_.t - until);
  pass_.open(t_);
}

/// The causes of an instant move it as they move with the columns before it.
void Tangents::take_causes(const Present& present, const std::vector<int>& due,
                           const std::vector<DueNow>& waiting, const Eigen::VectorXd& flow) {
  const Plan& plan = machine_->plan();
  const TangentColumns until = columns_;
  time_.open(t_);
  for (const Firing& firing : present.firings)
    time_.take(times_.of(firing, present.now(firing.guard()).jumped(), until, t_));
  for (const int event : due) time_.take(times_.of(plan.scheduled(event), until));
  for (const DueNow& one : waiting)
    time_.take({.by = waiting_.time_of(one.key), .event = one.event});
  for (const std::size_t k : at_zero_.beside(present, until, flow, time_.is_caused())) {
    const std::string& name = plan.guard((*guards_)[k].group).name;
    time_.take(times_.of_crossing(static_cast<Index>(k), name, t_, machine_->x.data(), until));
  }
  time_.settle();
}

void Tangents::commit() {
  pass_.commit(columns_);
  phase_ = Phase::committed;
  gaps_.lose_not_finite(t_, probe_.obstacle());
}

void Tangents::evaluated() {
  if (machine_->y.size() == 0) return;
  held_.follow(t_, columns_);
  gaps_.lose_not_finite(t_, held_.obstacle());
}

void Tangents::close() {
  events_.close(columns_.t);
  at_zero_.look_at_waiting(t_);
  if (machine_->carries())
    for (Index k = 0; k < size(); ++k)
      gaps_.lose(t_, k, "", "a block is carried by a moving surface");
  lose_beside_jump(columns_, time_.event(), jump_beside_event);
  TangentColumns fixed = columns_;
  fix_time(probe_, t_, machine_->x.data(), fixed);
  one_sided_.judge(t_, *machine_, columns_, fixed, time_.event());
  if (!flow_.autonomous()) columns_ = std::move(fixed);
  phase_ = Phase::between;
  kinks_.look(t_, columns_, gaps_);
  steps_.forget();
  dense_.instant();
}

void Tangents::accumulate(const void* monitor, std::span<const Index> states,
                          const Eigen::VectorXd& next) {
  if (events_.accumulate(monitor, states, next, pass_.next().x)) return;
  for (Index k = 0; k < size(); ++k) {
    if (!columns_.matters(k)) continue;
    pass_.next().x.col(k).setConstant(TangentGaps::none);
    pass_.next().z.col(k).setConstant(TangentGaps::none);
    gaps_.lose(t_, k, time_.event(),
               "the run began between the last events before the rest; begin it earlier");
  }
}

}  // namespace saltus
