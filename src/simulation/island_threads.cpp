// IslandRuns: islands on several threads.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "saltus/simulation/detail/island_runs.hpp"
#include "saltus/simulation/detail/side_by_side.hpp"

namespace saltus {

namespace {

void lower_to(std::atomic<double>& least, double value) {
  for (double now = least; value < now && !least.compare_exchange_weak(now, value);) {
  }
}

}  // namespace

std::size_t IslandRuns::threads() const {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const int asked = OneThread::asked() ? 1 : options_.island_threads;
  return std::min(asked == 0 ? cores : static_cast<std::size_t>(asked), all_.size());
}

/// Each island runs to the earliest end that is known when it begins. An island that comes further
/// than the end of all runs again, so its bits do not depend on the order.
double IslandRuns::run_side_by_side(double t_end) {
  std::atomic<double> end{t_end};
  const auto run = [&](std::size_t i) {
    if (interrupt_.stops()) return;
    const std::size_t k = order_[i];
    Run& island = *all_[k].run;
    Status status = Status::reached_end;
    if (interrupt_.is_on_caller()) {
      status = run_one(k, end);
      if (interrupt_.stops()) interrupt_.keep(island.results().cause);
    } else {
      status = island.advance_to(end);
      progress_.add(island, time_);
    }
    if (status != Status::reached_end) lower_to(end, island.time());
  };
  side_by_side(order_.size(), threads(), run, [this] { interrupt_.asks_between(); });
  stopped_ = interrupt_.stops();
  if (stopped_) {
    ender_ = 0;
    return end;
  }
  run_ties_again(t_end, end);
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const Run& island = *all_[k].run;
    if (island.results().status == Status::reached_end) continue;
    if (!ender_ || island.time() < all_[*ender_].run->time()) ender_ = k;
  }
  return end;
}

/// Which of several islands that end the run at one time knew of the end of another depends on the
/// threads. They run again as one after the other does: the first to `t_end`, and the others to its end.
void IslandRuns::run_ties_again(double t_end, double end) {
  std::vector<std::size_t> tied;
  for (const std::size_t k : order_) {
    const Run& island = *all_[k].run;
    if (island.results().status != Status::reached_end && island.time() == end) tied.push_back(k);
  }
  if (tied.size() < 2) return;
  for (const std::size_t k : tied) run_again(k, k == tied.front() ? t_end : end);
}

}  // namespace saltus
