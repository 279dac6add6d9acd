// IslandSchedule: islands between which event wires lead, in windows of time.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "saltus/plan/islands.hpp"
#include "saltus/simulation/detail/run_by_steps.hpp"

namespace saltus {

/// The conservative synchronisation of K. M. Chandy and J. Misra (IEEE Trans. Software Eng. 5
/// (1979) 440). No island fires before the earliest time M at which any of them ends its step, or
/// gets an event; so no island gets an event before M plus the shortest delay, other than those that
/// wait already. Up to there, the end of a window, the islands run one by one, or side by side. A
/// step may reach beyond the window: it counts once a later window has come to its end.
class IslandSchedule {
 public:
  /// The runs are those of the islands, in order.
  IslandSchedule(const Plan& plan, const Islands& islands, std::vector<RunBySteps*> runs);
  IslandSchedule(const IslandSchedule&) = delete;

  /// A run begins, with the deliveries that wait in a context; the runs of the islands are
  /// initialized.
  void begin(const Context& from);

  /// How a piece of the run ended.
  struct End {
    double time;                             ///< [s]
    std::optional<std::size_t> island = {};  ///< that ended it before its end
    bool passed = false;                     ///< some island is beyond that time already
    bool stopped = false;                    ///< by `asks`
  };
  /// Runs all islands to t_end [s], but not beyond `latest` [s] or the earliest end that one of them
  /// has. `asks()` is called after each window on the calling thread: true stops the run.
  End run(double t_end, double latest, std::size_t threads, const std::function<bool()>& asks);

  /// Whether a firing with these wires, of the context of all islands, is also delivered within the
  /// island of the event.
  bool is_inside(const PendingDelivery& one) const;
  /// The firings that wait for other islands at t [s], except those that wait in their own, too.
  std::vector<PendingDelivery> waiting(double t) const;
  /// [s] No island has an event before.
  double time() const noexcept { return time_; }

 private:
  using Entry = std::pair<double, std::size_t>;  // [s] RunBySteps::next of an island

  void find_sources(std::size_t k);
  void find_ends(std::size_t number);
  void require_apart(double t_end) const;
  int island_of(int leaf) const { return islands_->of_leaf[leaf]; }
  void post(double due, int batch);
  void post_fired(std::size_t k);
  void enqueue(std::size_t k);
  bool take_window(const End& end);
  void run_window(const End& end, std::size_t threads);
  void close_window(End& end);
  void note_end(std::size_t k, End& end);
  bool has_passed(double t) const;
  void finish(End& end);

  const Plan* plan_;
  const Islands* islands_;
  std::vector<RunBySteps*> runs_;
  List<int> numbers_;                // of each leaf in its island
  std::vector<List<int>> sources_;   // of each island: the number in the plan of each source
  List<char> inside_, outside_;      // of each batch: it has targets in its own island, in others
  double shortest_;                  // [s] of the delays between islands
  std::vector<Entry> queue_;         // a heap, with entries that are outdated
  List<double> next_;                // [s] of each island: that of its last entry
  std::vector<std::size_t> window_;  // the islands that run
  double safe_ = 0.0;                // [s] the end of the window
  double time_ = 0.0;                // [s]
  std::multimap<double, int> sent_;  // batches by due time, until no context needs them
};

}  // namespace saltus
