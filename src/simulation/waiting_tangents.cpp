// Tangents: what an instant leaves for later, and what an earlier one left.
#include <cmath>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

/// A value that a trigger does not change keeps the derivative that it had, up to this part.
constexpr double same_value = 1e-6;

}  // namespace

/// A delivery waits: its delay is a constant.
void Tangents::wait(std::int64_t number) {
  waits_.add({WaitingKey::Queue::deliveries, number}, {columns_.t, {}, {}});
}

/// An execution waits. Its delay is a number or a function.
void Tangents::schedule(const PendingExecution& one, const Transition::Call& call,
                        const NumberOf* delay, const Transition::Seen& seen) {
  TangentWaits::Waiting waiting{columns_.t, {}, {}};
  if (delay != nullptr && !delay->is_constant()) waiting.time += of_number(*delay, seen);
  const PlanLeaf& leaf = machine_->plan().leaf(one.leaf);
  if (one.frozen) {
    const Eigen::MatrixXd by = of_call(call, seen);
    waiting.x = by.topRows(leaf.nx), waiting.z = by.bottomRows(leaf.nz);
    look_at_unchanged(one.values.continuous_entries, waiting.x, next_x_.middleRows(leaf.x, leaf.nx),
                      call);
    look_at_unchanged(one.values.discrete_entries, waiting.z, next_z_.middleRows(leaf.z, leaf.nz),
                      call);
  }
  waits_.add({WaitingKey::Queue::executions, one.number}, std::move(waiting));
}

Eigen::RowVectorXd Tangents::of_number(const NumberOf& number, const Transition::Seen& seen) {
  const LeafSystem& system = *machine_->plan().leaf(seen.leaf).system;
  return of_seen(seen, 1, [&](const MovedAlong&, At& at, double* to) { *to = number(system, at); });
}

/// An execution writes the values that a trigger changed. One that it left as it was is written for
/// other parameters, if it moves away from the value that was there.
void Tangents::look_at_unchanged(const std::vector<int>& changed, const Eigen::MatrixXd& by,
                                 const Eigen::MatrixXd& before, const Transition::Call& call) {
  for (Index i = 0; i < by.rows(); ++i) {
    if (std::ranges::find(changed, static_cast<int>(i)) != changed.end()) continue;
    for (Index k = 0; k < size(); ++k) {
      const double terms = std::abs(by(i, k)) + std::abs(before(i, k));
      if (std::abs(by(i, k) - before(i, k)) > same_value * terms)
        lose(k, std::string(call.source), "a value is equal to the one that it replaces");
    }
  }
}

/// Something that was due is taken out. Where its time moves otherwise than that of the instant, it
/// happens in another instant for other parameters.
TangentWaits::Waiting Tangents::take(const WaitingKey& key, const std::string& event) {
  TangentWaits::Waiting taken = waits_.take(key);
  for (Index k = 0; k < size(); ++k)
    if (moves_apart(columns_.t[k], taken.time[k]))
      lose(k, event, "its delay is zero here, and moves, so that it is due at another time");
  return taken;
}

void Tangents::take_delivery(std::int64_t number, const std::string& event) {
  take({WaitingKey::Queue::deliveries, number}, event);
}

void Tangents::take_execution(std::int64_t number, const std::string& event) {
  taken_ = take({WaitingKey::Queue::executions, number}, event);
}

void Tangents::cancel(std::int64_t number) { waits_.take({WaitingKey::Queue::executions, number}); }

/// The execution that was taken writes values of its trigger. They are constant if it waited when the
/// run began.
void Tangents::write_frozen(const PendingExecution& one) {
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
  write(one.values.continuous_entries, taken_.x, leaf.x, next_x_);
  write(one.values.discrete_entries, taken_.z, leaf.z, next_z_);
}

/// Several executions are due at one time with one priority, so their numbers, or a draw, decide. For
/// other parameters the priorities may decide.
void Tangents::tie(const std::vector<PriorityOf>& all) {
  const Eigen::RowVectorXd first = of_priority(all.front());
  for (const PriorityOf& one : all) {
    const Eigen::RowVectorXd other = of_priority(one);
    for (Index k = 0; k < size(); ++k)
      if (moves_apart(first[k], other[k]))
        lose(k, one.event, "another execution has the same priority, and their order would change");
  }
}

/// A priority sees the present states, as Executions::priority_of.
Eigen::RowVectorXd Tangents::of_priority(const PriorityOf& one) {
  Eigen::RowVectorXd by = Eigen::RowVectorXd::Zero(size());
  if (one.priority == nullptr || one.priority->is_constant()) return by;
  const LeafSystem& system = *machine_->plan().leaf(one.leaf).system;
  for (Index k = 0; k < size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* to) {
      At at = probe.at(one.leaf, t_ + shift * columns_.t[k], probe.x.data());
      at.entry = one.entry;
      *to = (*one.priority)(system, at);
    };
    probe_.derivative(machine_->x.data(), columns_.column(k), 1, read, &by[k]);
  }
  return by;
}

}  // namespace saltus
