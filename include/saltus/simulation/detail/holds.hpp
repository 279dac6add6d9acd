// Holds: when the firings of a guard accumulate, and which states rest then.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/flow.hpp"
#include "saltus/simulation/detail/journal.hpp"
#include "saltus/simulation/detail/state_parts.hpp"
#include "saltus/simulation/detail/zeno.hpp"

namespace saltus {

/// The Zeno monitors: one for each guard with an effect, one for each watched edge. Holds knows
/// which states rest; ContactGuards operates their guards meanwhile.
class Holds {
 public:
  struct Hold {
    ZenoMonitor monitor{};
    int leaf = -1, source = -1;
    Index entry = 0;
    OnZeno on_zeno = {};
    std::vector<int> groups = {};         ///< the guards whose firings it watches
    std::span<const Index> of_plan = {};  ///< entries of x that rest, by what the plan knows
    std::span<const Index> states = {};   ///< those of this run: of an earlier one, if it goes on
    std::vector<Index> earlier = {};      ///< room for `states`
    ZenoMonitor before{};                 ///< the monitor before the instant, once it has changed
    bool changed = false;                 ///< in this instant
  };

  Holds(Machine& machine, const GuardSet& guards, const SimulatorOptions& options, Flow& flow,
        Transition& transition, Journal& journal, Present& present);

  /// A run begins: nothing rests.
  void begin();
  /// An instant begins: no monitor has changed yet.
  void open();
  /// The monitors are as before the instant.
  void undo();

  Hold& of_guard(std::integral auto k) { return of_guards_[k]; }
  const Hold& of_guard(std::integral auto k) const { return of_guards_[k]; }
  Hold& of_edge(std::integral auto e) { return of_edges_[e]; }
  const Hold& of_edge(std::integral auto e) const { return of_edges_[e]; }
  bool any() const noexcept { return count_ > 0; }
  /// Whether the present pass, not yet committed, has written the states that rest.
  bool kicked(const Hold& hold) const;

  /// Notes a firing at t.
  void fired(Hold& hold, double t);
  /// Acts on a Zeno point as the author of the guard chose: its firings accumulate, or its flow
  /// leads straight back. `in_pass`: the modes to come may still be written.
  void come_to_rest(Hold& hold, double predicted, bool in_pass);
  void release(Hold& hold);
  /// Comes to rest after a firing whose reset map wrote, if the firings accumulate; otherwise notes
  /// how soon the next firing may follow. Returns whether it rests.
  bool look_for_accumulation(Hold& hold);
  /// A relation at rest holds the blocks whose edges it set off. False if an edge has no monitor.
  bool hold_edges(const std::vector<int>& edges, int node);

  /// Saves the last firings of each monitor, which a continued run needs.
  std::vector<Continuation::Firings> save() const;
  /// Throws ModelError where their number fits and their states are not of their block.
  bool fits(const Continuation& from) const;
  void load(const Continuation& from);

 private:
  ZenoMonitor new_monitor(std::optional<double> own) const;
  void add_guards(const GuardSet& guards);
  void add_edges();
  bool steers(const ZeroCrossing& crossing, int leaf) const;
  bool left_at_zero(const Hold& hold);
  bool accumulates(const Hold& hold);
  ZenoMonitor& changing(Hold& hold);
  void load(Hold& hold, const Continuation::Firings& saved);
  void rest(Hold& hold, double predicted);
  [[noreturn]] void throw_accumulation(const Hold& hold, double predicted) const;

  Machine* machine_;
  const SimulatorOptions* options_;
  Flow* flow_;
  Transition* transition_;
  Journal* journal_;
  Present* present_;
  StateParts parts_;
  List<Hold> of_guards_, of_edges_;
  Eigen::VectorXd gathered_;    // the states of one hold
  std::vector<double> values_;  // of all guards after a reset
  int count_ = 0;               // present holds
  std::vector<Hold*> changed_;  // in this instant
};

}  // namespace saltus
