// Instant rows: the row before a pass, with the relations that fired.
#include "saltus/simulation/detail/instant_rows.hpp"

#include <algorithm>

#include "saltus/plan/detail/needs.hpp"

namespace saltus {

void InstantRows::before(int jump, bool flipped) {
  if (recorder_ == nullptr) return;
  if (flipped) {
    follow_flips();
    recorder_->replace(present_->t, jump, machine_->x.data());
  } else if (!recorder_->has_row(present_->t, jump)) {
    recorder_->record(present_->t, jump, machine_->x.data());
  }
}

/// Held signals follow the relations. Those that change at this time by themselves, because a time
/// event is due, still have their values before it.
void InstantRows::follow_flips() {
  const bool due = present_->pass == 0 && !present_->actions.empty();
  if (due) y_before_ = machine_->y;
  machine_->evaluate_instant(present_->t);
  if (due) put_back_what_does_not_follow();
}

void InstantRows::put_back_what_does_not_follow() {
  const Plan& plan = machine_->plan();
  follows_.assign(plan.nodes.size(), 0);
  for (const std::size_t k : scope_->relations) {
    if (present_->now(k).fired_in_pass) follows_[plan.guard((*guards_)[k].group).index] = 1;
  }
  for (const int i : plan.order) {
    const Node& node = plan.node(i);
    char& follows = follows_[i];
    const bool moves = !samples(detail::reads_of(plan, node));
    follows = follows || (moves && std::ranges::any_of(
                                       node.needs, [&](int need) { return follows_[need] != 0; }));
    if (follows || node.place.space != Space::y) continue;
    machine_->y.segment(node.place.offset, node.place.size) =
        y_before_.segment(node.place.offset, node.place.size);
  }
}

}  // namespace saltus
