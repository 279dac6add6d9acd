// What waits: added, taken, and compared with what is due beside it.
#include "saltus/simulation/detail/waiting_tangents.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/simulation/detail/tangent_times.hpp"

namespace saltus {

namespace {

/// A value that a trigger does not change keeps the derivative that it had, up to this part.
constexpr double same_value = 1e-6;

}  // namespace

/// A delivery waits: its delay is a constant.
void WaitingTangents::wait(std::int64_t number) {
  waits_.add({WaitingKey::Queue::deliveries, number}, {columns_->t, {}, {}});
}

/// An execution waits. Its delay is a number or a function.
void WaitingTangents::schedule(const PendingExecution& one, const Transition::Call& call,
                               const NumberOf* delay, const Transition::Seen& seen) {
  TangentWaits::Waiting waiting{columns_->t, {}, {}};
  if (delay != nullptr && !delay->is_constant()) waiting.time += pass_->called().of(*delay, seen);
  const PlanLeaf& leaf = machine_->plan().leaf(one.leaf);
  if (one.frozen) {
    const Eigen::MatrixXd by = pass_->called().of(call, seen);
    waiting.x = by.topRows(leaf.nx), waiting.z = by.bottomRows(leaf.nz);
    const NextColumns& next = std::as_const(*pass_).next();
    look_at_unchanged(one.values.continuous_entries, waiting.x, next.x.middleRows(leaf.x, leaf.nx),
                      call);
    look_at_unchanged(one.values.discrete_entries, waiting.z, next.z.middleRows(leaf.z, leaf.nz),
                      call);
  }
  waits_.add({WaitingKey::Queue::executions, one.number}, std::move(waiting));
}

/// An execution writes the values that a trigger changed. One that it left as it was is written for
/// other parameters, if it moves away from the value that was there.
void WaitingTangents::look_at_unchanged(const std::vector<int>& changed, const Eigen::MatrixXd& by,
                                        const Eigen::MatrixXd& before,
                                        const Transition::Call& call) {
  for (Index i = 0; i < by.rows(); ++i) {
    if (std::ranges::find(changed, static_cast<int>(i)) != changed.end()) continue;
    for (Index k = 0; k < columns_->size(); ++k) {
      const double terms = std::abs(by(i, k)) + std::abs(before(i, k));
      if (std::abs(by(i, k) - before(i, k)) > same_value * terms)
        lose(k, std::string(call.source), "a value is equal to the one that it replaces");
    }
  }
}

/// Something that was due is taken out. Where its time moves otherwise than that of the instant, it
/// happens in another instant for other parameters.
TangentWaits::Waiting WaitingTangents::take(const WaitingKey& key, const std::string& event) {
  TangentWaits::Waiting taken = waits_.take(key);
  for (Index k = 0; k < columns_->size(); ++k)
    if (moves_apart(columns_->t[k], taken.time[k]))
      lose(k, event, "its delay is zero here, and moves, so that it is due at another time");
  return taken;
}

void WaitingTangents::take_delivery(std::int64_t number, const std::string& event) {
  take({WaitingKey::Queue::deliveries, number}, event);
}

void WaitingTangents::take_execution(std::int64_t number, const std::string& event) {
  taken_ = take({WaitingKey::Queue::executions, number}, event);
}

void WaitingTangents::cancel(std::int64_t number) {
  waits_.take({WaitingKey::Queue::executions, number});
}

/// The execution that was taken writes values of its trigger. They are constant if it waited when the
/// run began.
void WaitingTangents::write_frozen(const PendingExecution& one) {
  const PlanLeaf& leaf = machine_->plan().leaf(one.leaf);
  const auto write = [&](const std::vector<int>& entries, const Eigen::MatrixXd& from, Index first,
                         Eigen::MatrixXd& to) {
    for (const int i : entries) {
      if (from.size() == 0)
        to.row(first + i).setZero();
      else
        to.row(first + i) = from.row(i);
    }
  };
  write(one.values.continuous_entries, taken_.x, leaf.x, pass_->next().x);
  write(one.values.discrete_entries, taken_.z, leaf.z, pass_->next().z);
}

/// Several executions are due at one time with one priority, so their numbers, or a draw, decide. For
/// other parameters the priorities may decide.
void WaitingTangents::tie(const std::vector<PriorityOf>& all) {
  const Eigen::RowVectorXd first = pass_->called().of(all.front());
  for (const PriorityOf& one : all) {
    const Eigen::RowVectorXd other = pass_->called().of(one);
    for (Index k = 0; k < columns_->size(); ++k)
      if (moves_apart(first[k], other[k]))
        lose(k, one.event, "another execution has the same priority, and their order would change");
  }
}

}  // namespace saltus
