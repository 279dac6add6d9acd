// IslandTangents: the derivatives of all islands as those of one run.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "saltus/plan/islands.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

/// Writes `Results::sensitivities` of a run by islands. An island has columns for the parameters and
/// start values of its own blocks. Nothing in it depends on other islands, so the other columns are
/// zero.
class IslandTangents {
 public:
  /// The layout of the contexts of a plan, without the systems to which its leaves belong.
  static Layout layout_of(const Plan& plan);

  /// `names` is the option `sensitivity` of the whole run; without names nothing is written. Throws
  /// ModelError as `chosen_entries` does.
  IslandTangents(const Plan& plan, const Islands& islands, std::vector<std::string> names,
                 Results& results);

  /// The names that belong to blocks of island k, or to its copies of sources.
  std::vector<std::string> names_of(std::size_t k) const;

  /// The results have no rows and no events. Gaps up to `since` [s] were in earlier results.
  void renew(double since = -std::numeric_limits<double>::infinity());
  /// Rows of a signal: first to last - 1 of signal `from` of an island, which is `to` of the whole.
  struct Rows {
    std::size_t from;
    int to;
    std::size_t first, last;
  };
  void add_rows(std::size_t k, const Results& from, const Rows& rows);
  void add_event(std::size_t k, const Results& from, std::size_t event);
  /// The final state, and the gaps, of all islands begin anew; `finish` adds those of island k, and
  /// `end` puts the gaps in order.
  void begin_end();
  void finish(std::size_t k, const Results& from);
  void end();

 private:
  bool empty() const { return parameters_.empty(); }
  /// Appends a group of numbers, one for each column of all. Columns of other islands have `other`.
  void append(std::size_t k, const double* values, double other, std::vector<double>& out) const;
  TangentTrajectory::Part part_of(std::size_t k, const Results& from) const;
  void write_state(std::size_t k, const std::vector<double>& from, Index PlanLeaf::*offset,
                   Index PlanLeaf::*size, std::vector<double>& to) const;

  const Plan* plan_;
  const Islands* islands_;
  Results* results_;
  std::vector<std::string> names_, parameters_;    // as they were given; entry by entry
  std::vector<std::vector<std::size_t>> asked_;    // of each island: the names that belong to it
  std::vector<std::vector<std::size_t>> columns_;  // of each island: its columns among all
  std::vector<TangentTrajectory::Part> parts_;     // of each island
  double since_ = 0.0;                             // [s]
};

}  // namespace saltus
