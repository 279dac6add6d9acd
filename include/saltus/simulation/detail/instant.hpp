// Instant: all that happens at one time value, in passes, until nothing changes.
#pragma once

#include <cmath>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "saltus/simulation/detail/contact.hpp"
#include "saltus/simulation/detail/departure.hpp"
#include "saltus/simulation/detail/recorder.hpp"
#include "saltus/simulation/detail/zeno.hpp"
#include "saltus/solver/detail/watch.hpp"

namespace saltus {

/// One pass: relations that were crossed flip; held outputs follow; reset maps and updates run, all
/// from x-, and are committed together; relations are read again; what the commit moved across zero
/// fires in the next pass.
class Instant {
 public:
  struct Outcome {
    bool restart = false;  ///< the solver's picture of f is no longer right
    bool terminal = false;
    bool stuck = false;      ///< a guard at rest, without monitor, fires again as soon as it can
    bool flutters = false;   ///< a relation flipped three times or more: both sides lead back
    int events = 0;          ///< how many there were
    bool zeno_stop = false;  ///< a Zeno point of a guard that stops there
    bool chatters = false;   ///< it does not end, though no state was written
    double horizon =
        std::numeric_limits<double>::infinity();  ///< [s] within which an event may follow
  };

  Instant(Machine& machine, Watch& watch, const SimulatorOptions& options, Results& results);

  /// Clean monitors, relations and held signals for a run that begins at t. Nothing fires yet.
  void begin(double t, Recorder* recorder);
  bool fits(const Continuation& from) const;
  /// The same, as an earlier run left them; `longest` as in run.
  void resume(double t, Recorder* recorder, const Continuation& from, double longest);
  /// What a run that goes on from here has to know.
  Continuation save() const;

  /// Runs the instant at t: the guards in watch.fired, and the time events in `due`. `longest` [s]:
  /// how far the run still goes.
  Outcome run(double t, const std::vector<int>& due, double longest, bool at_start = false);

  /// Logs the crossings of monitors; they change nothing.
  void log_monitor(const MonitorHit& hit, const double* x);

  int jump() const noexcept { return jump_; }
  const Contacts& contacts() const noexcept { return contacts_; }
  /// f at the end of the last instant, if that is known.
  const Eigen::VectorXd* flow() const noexcept { return flowed_ ? &departure_.flow() : nullptr; }
  /// "block.event" of the last event; empty before there was one.
  const std::string& last_event() const;
  /// How often each event happened, by name; those that did not are left out.
  std::vector<std::pair<std::string, std::int64_t>> counts() const;

 private:
  static constexpr int lifts_off = 2;  // in place of the side a firing came from: a hold that ends

  enum class Cause { crossing, edge, time, zeno };
  struct Action {
    int leaf;
    Cause cause;
    int index;   // guard group, edge watch or scheduled event; of a Zeno point its source
    int slot;    // of a crossing
    int from;    // side a crossing came from; of a Zeno point the mode to enter
    bool carry;  // the reset map of a leaf on hold, applied again
  };
  /// What the present instant knows of one guard.
  struct SlotNow {
    double g_minus = 0.0;  // what the location of its root left of it
    /// [s] From one firing to the next, where it was not seen clearly off zero in between; else
    /// NaN.
    double flight = std::numeric_limits<double>::quiet_NaN();
    int flips = 0;  // of a relation
    bool fired = false;
    bool frozen = false;  // a relation: it keeps its side
    bool turned = false;  // a relation: its side changed when it was read again
  };
  /// A guard or an edge with an effect: when its firings accumulate, and what rests then.
  struct Rest {
    ZenoMonitor monitor{};
    int leaf = -1, source = -1;
    Index entry = 0;
    OnZeno on_zeno = {};
    std::span<const Index> states = {};  // entries of x that rest on a hold
  };

  // instant_setup.cpp
  void add_rests();
  void settle_relations(double t);
  void select_guards();
  void log(EventKind kind, int source, int leaf_index, int direction,
           double predicted = std::numeric_limits<double>::quiet_NaN(), Index entry = 0);

  // instant_passes.cpp
  void open(double t, const std::vector<int>& due);
  bool flip_relations();
  bool collect_edges();
  void collect_carried(int edge);
  void add_crossings();
  void run_pass();
  void run_action(const Action& action);
  void run_update(const Action& action);
  void look_for_zeno(const Action& action, Rest& rest);
  bool run_reset(const Action& action, const ResetMap& map);
  void commit();
  [[noreturn]] void throw_no_end() const;

  // instant_reading.cpp
  void read_again();
  bool read_relation(const GuardGroup& group, Index slot);
  bool reads_changed(int node) const;
  /// [s] shorter flights drown in the rounding of the time.
  double least_time() const { return 64.0 * std::numeric_limits<double>::epsilon() * std::abs(t_); }
  void find_next();

  // instant_arming.cpp
  void arm(bool at_start);
  void arm_crossing(const GuardGroup& group, std::size_t slot, bool at_start);
  double hair_of(std::size_t slot) const;
  bool at_zero(const GuardGroup& group, std::size_t slot, bool entered);
  void arm_at_zero(const GuardGroup& group, std::size_t slot, Departure::Side flow, bool at_start);
  bool too_low(const GuardGroup& group, std::size_t slot);
  bool reset_turns(const GuardGroup& group, std::size_t slot, int from);
  void arm_fired(const GuardGroup& group, std::size_t slot, int from, Departure::Side flow);
  bool begin_on_firing_side(const GuardGroup& group, std::size_t slot);
  void arm_relation(const GuardGroup& group, std::size_t slot);
  Departure::Side side_of(const GuardGroup& group, Index slot, double hair, int expected);
  bool rests(const GuardGroup& group, Index slot, int from);
  bool turned_round(const GuardGroup& group, Index slot, int side);

  // instant_holds.cpp
  void come_to_rest(Rest& rest, double predicted, bool in_pass);
  void hold(Rest& rest, double predicted);
  void release(Rest& rest);
  bool sets_off(int node) const;
  bool hold_edges_of(int node);
  void rest_relations_of(const EdgeWatch& edge);
  bool look_at_firings();
  bool goes_against(const Firing& firing);
  void release_kicked();
  void release_unseen();

  // instant_contacts.cpp
  SurfaceContact* contact_of(std::size_t slot);
  SurfaceContact* contact_of_crossing(std::size_t slot);
  SurfaceContact* contact_of_relation(std::size_t slot);
  void leave_contact(std::size_t slot);
  void arm_crossing_at_rest(std::size_t slot);
  void arm_relation_at_rest(std::size_t slot);
  void arm_contact(SurfaceContact& contact, double band);
  bool wake(SurfaceContact& contact);
  void let_go(SurfaceContact& contact);
  void look_at_held(std::size_t slot);
  bool still_at_rest(SurfaceContact& contact);

  // shared
  const Plan& plan() const { return machine_->plan(); }
  const PlanLeaf& leaf(int i) const { return plan().leaves[static_cast<std::size_t>(i)]; }
  const ZeroCrossing& crossing_of(const GuardGroup& group) const {
    return leaf(group.leaf).declared().zero_crossings[static_cast<std::size_t>(group.index)];
  }
  const EdgeReset& reset_of(const EdgeWatch& edge) const {
    return leaf(edge.leaf).declared().edge_resets[static_cast<std::size_t>(edge.index)];
  }
  const GuardGroup& group_of(std::size_t slot) const {
    return plan().guards[static_cast<std::size_t>(group_of_slot_[slot])];
  }
  /// The held truth of a relation, by its slot.
  double& truth_of(std::size_t slot) {
    const GuardGroup& group = group_of(slot);
    return machine_->signal(group.index)[static_cast<Index>(slot) - group.slot];
  }
  /// Whether this firing of a terminal guard is the one that ends the run.
  bool ends_run(std::size_t group) const {
    const ZeroCrossing& crossing = crossing_of(plan().guards[group]);
    return crossing.terminal && earlier_[group] + counts_[group] + 1 >= crossing.max_count;
  }
  bool has_effect(const GuardGroup& group) const {
    return crossing_of(group).reset_map || crossing_of(group).end_mode;
  }
  const std::string& name_of(int source) const;
  int source_of(Cause cause, int index) const {
    const auto groups = static_cast<int>(plan().guards.size()),
               edges = static_cast<int>(plan().edges.size());
    return cause == Cause::crossing ? index
           : cause == Cause::edge   ? groups + index
                                    : groups + edges + index;
  }
  bool held_outputs_changed() const;
  bool changed(const Place& place) const;

  Machine* machine_;
  Watch* watch_;
  const SimulatorOptions* options_;
  Results* results_;
  Recorder* recorder_ = nullptr;
  Departure departure_;
  Contacts contacts_;

  std::vector<int> group_of_slot_;
  std::vector<Index> states_;            // all entries of x: what a whole leaf rests with
  std::deque<std::vector<Index>> held_;  // what guards with `holds` rest with
  std::vector<Rest> slot_rests_, edge_rests_;
  std::vector<char> edge_values_, carried_;

  double t_ = 0.0, longest_ = 0.0;
  int jump_ = 0, pass_ = 0;
  int event_jump_ = 0;  // of the events logged now
  int last_source_ = -1;
  Outcome outcome_;
  std::vector<Firing> firings_;  // for the pass to come
  std::vector<Action> actions_;
  std::vector<SlotNow> now_;
  std::vector<char> fired_now_;    // slots: in this pass
  std::vector<char> was_active_;   // slots: for select_guards
  std::vector<char> resting_;      // slots of relations: their side is kept through the hold
  std::vector<signed char> from_;  // slots: the side the last crossing came from
  std::vector<int> edges_fired_;   // in this instant
  bool wrote_ = false;             // the last pass wrote states
  bool wrote_x_ = false;           // some pass of this instant wrote continuous state
  bool entered_ = false;           // some pass of this instant entered a mode
  bool flowed_ = false;            // departure_ stands at the present (t, x)
  std::vector<double> armed_at_;   // [s] slots: fresh since then after a firing; NaN if not
  int effects_ = 0;                // reset maps that wrote continuous state in this instant
  int holds_ = 0;
  Eigen::VectorXd trial_, trial_z_;
  Eigen::VectorXd gathered_;  // what rests, of one hold
  Eigen::VectorXd x_minus_, z_minus_, x_next_, z_next_, y_before_, flow_before_;
  std::vector<int> modes_next_, modes_before_;
  std::vector<double> g_;              // guards now
  std::vector<std::int64_t> counts_;   // events of each source
  std::vector<std::int64_t> earlier_;  // guards: how often they had fired before this run
  std::vector<int> chain_;             // sources of what happened in this instant
};

}  // namespace saltus
