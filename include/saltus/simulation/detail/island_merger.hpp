// IslandMerger: one event log, one set of rows, and one sum of counts, of all islands.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "saltus/plan/islands.hpp"
#include "saltus/simulation/detail/island_tangents.hpp"
#include "saltus/simulation/detail/run.hpp"

namespace saltus {

/// Writes the rows, the events and the statistics of the results of a run by islands. It appends what
/// the runs of the islands have made since the last call, because it is called between pieces of a
/// run too.
class IslandMerger {
 public:
  /// The results of one island.
  struct Part {
    const Run* run;
    std::vector<int> sources;          ///< the number in the whole plan of each source of events
    std::vector<int> signals;          ///< the number in the whole plan of each recorded signal
    std::size_t rows = 0, events = 0;  ///< the number that the results have already
    int jump = 0;                      ///< j of the last event that the results have
  };

  /// `table`: all signals have one table. `sensitivity` is the option of the whole run. An island is
  /// added by `add`, in the order of the islands.
  IslandMerger(std::shared_ptr<const Plan> plan, const Islands& islands, bool table,
               const std::vector<std::string>& sensitivity, Results& results);

  void add(Part part) { parts_.push_back(std::move(part)); }
  /// The names of the option `sensitivity` that belong to island k.
  std::vector<std::string> sensitivity_of(std::size_t k) const { return tangents_.names_of(k); }
  /// All sources of events.
  const std::vector<EventName>& names() const noexcept { return names_; }

  /// A run begins; the jump of island k does at jumps[k].
  void begin(const std::vector<int>& jumps);
  /// Results of empty columns, from `since` [s] on.
  void renew(double since = -std::numeric_limits<double>::infinity());
  /// The islands have run on, for so many seconds of wall time.
  void ran(double wall_time) { wall_time_ += wall_time, merged_ = false; }
  void merge();

 private:
  void merge_rows(std::size_t k);
  void merge_table();
  void merge_events();
  bool owns(std::size_t k, int source) const { return owners_[source] == static_cast<int>(k); }
  void merge_statistics();
  void merge_tangents();
  void merge_trajectories();

  std::shared_ptr<const Plan> plan_;
  const Islands* islands_;
  std::vector<EventName> names_;
  List<int> owners_;  // the island of each source of events; its other islands have copies of it
  bool table_;
  Results* results_;
  IslandTangents tangents_;
  std::vector<Part> parts_;
  double wall_time_ = 0.0;  // [s]
  double since_ = 0.0;      // [s] where the results begin
  bool merged_ = true;      // since the last piece of the run
};

/// Adds the counts of one run to a sum.
void add_counts(Statistics& sum, const Statistics& one);

}  // namespace saltus
