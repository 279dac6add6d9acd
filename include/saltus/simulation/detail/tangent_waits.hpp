// TangentWaits: the derivatives of what waits, deliveries of event wires and executions.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>

namespace saltus {

/// Who waits: its queue, and its number there.
struct WaitingKey {
  enum class Queue { deliveries, executions };
  Queue queue = Queue::deliveries;
  std::int64_t number = 0;
  auto operator<=>(const WaitingKey&) const = default;
};

/// Something that is due now, and the event that it follows from.
struct DueNow {
  WaitingKey key;
  std::string event;
};

/// The derivatives of the times at which deliveries and executions are due, and of values that were
/// computed at a trigger. What waits from an earlier run has fixed times and values.
class TangentWaits {
 public:
  struct Waiting {
    Eigen::RowVectorXd time;
    Eigen::MatrixXd x, z;  ///< of the values, a row for each state of the block; empty: none
  };

  /// A run with so many columns begins.
  void begin(Eigen::Index columns) { all_.clear(), fixed_.setZero(columns); }
  void add(const WaitingKey& key, Waiting waiting) { all_[key] = std::move(waiting); }
  const Eigen::RowVectorXd& time_of(const WaitingKey& key) const {
    const auto found = all_.find(key);
    return found == all_.end() ? fixed_ : found->second.time;
  }
  /// Takes it out; with fixed values and time if it is not known.
  Waiting take(const WaitingKey& key) {
    const auto found = all_.find(key);
    if (found == all_.end()) return {fixed_, {}, {}};
    Waiting taken = std::move(found->second);
    all_.erase(found);
    return taken;
  }

 private:
  std::map<WaitingKey, Waiting> all_;
  Eigen::RowVectorXd fixed_;
};

}  // namespace saltus
