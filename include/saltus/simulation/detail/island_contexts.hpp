// IslandContexts: the contexts of the islands, and the one context of all.
#pragma once

#include <memory>
#include <vector>

#include "saltus/plan/islands.hpp"
#include "saltus/simulation/detail/island_schedule.hpp"

namespace saltus {

/// Divides a context among the islands, and puts the contexts of the islands together. A block that belongs to
/// several islands is owned by one of them, whose values count; the other islands have copies.
class IslandContexts {
 public:
  /// An island is added by `add`, in order.
  IslandContexts(const Plan& plan, const Islands& islands) : plan_(&plan), islands_(&islands) {}
  void add(const Plan& part);
  /// Event wires lead from island to island.
  void wire(const IslandSchedule& schedule) { schedule_ = &schedule; }

  /// Refuses the context of a run with one common step: it has the records of all guards in one
  /// list. Refuses deliveries of blocks in no island, too.
  void require_fits(const Context& whole) const;
  /// The values of island k, to which its run fits.
  Context part_of(const Context& whole, std::size_t k) const;
  /// The values of all islands at t [s], of a run that began with `begin`. It is `begin` where an island
  /// ended before its first instant.
  Context whole_of(const Context& begin, double t, const std::vector<Context>& parts) const;

 private:
  std::shared_ptr<const PendingExecutions> pending_of(const PendingExecutions& whole,
                                                      std::size_t k) const;
  std::shared_ptr<const PendingExecutions> pending_of(double t,
                                                      const std::vector<Context>& parts) const;
  void add_pending(PendingExecutions& whole, const PendingExecutions& part, std::size_t k) const;
  void write_values(ContextValues& whole, const Context& part, std::size_t k) const;

  const Plan* plan_;
  const Islands* islands_;
  const IslandSchedule* schedule_ = nullptr;
  std::vector<std::shared_ptr<const Layout>> layouts_;  // of the islands
  int queue_ = -1;  // the island that has the queue of executions
};

}  // namespace saltus
