// Instant: all that happens at one time value, in passes, until nothing changes.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "saltus/simulation/departure.hpp"
#include "saltus/simulation/recorder.hpp"
#include "saltus/simulation/zeno.hpp"
#include "saltus/solver/watch.hpp"

namespace saltus {

/// One pass: relations that were crossed flip; held outputs follow; reset maps and updates run, all
/// from x-, and are committed together; relations are read again; what the commit moved across zero
/// fires in the next pass.
class Instant {
 public:
  struct Outcome {
    bool changed = false;  ///< some pass changed something
    bool restart = false;  ///< the solver's picture of f is no longer right
    bool terminal = false;
    bool chatters = false;  ///< it does not end, though no state was written
    double horizon =
        std::numeric_limits<double>::infinity();  ///< [s] within which an event may follow
  };

  Instant(Machine& machine, Watch& watch, const SimulatorOptions& options, Results& results);

  /// Clean monitors, relations and held signals for a run that begins at t. Nothing fires yet.
  void begin(double t, Recorder* recorder);

  /// Runs the instant at t: the guards in watch.fired, and the time events in `due`. `longest` [s]:
  /// how far the run still goes.
  Outcome run(double t, const std::vector<int>& due, double longest, bool at_start = false);

  /// Logs the crossings of monitors; they change nothing.
  void log_monitor(const MonitorHit& hit, const double* x);

  int jump() const noexcept { return jump_; }
  /// How often each event happened, by name; those that did not are left out.
  std::vector<std::pair<std::string, std::int64_t>> counts() const;

 private:
  enum class Cause { crossing, edge, time };
  struct Action {
    int leaf;
    Cause cause;
    int index;   // guard group, edge watch or scheduled event
    int slot;    // of a crossing
    int from;    // side a crossing came from
    bool carry;  // the reset map of a leaf on hold, applied again
  };

  // instant_passes.hpp
  bool flip_relations();
  bool collect_edges();
  void collect_carried(int edge);
  void add_crossings();
  void run_pass();
  void run_action(const Action& action);
  bool run_reset(const Action& action, const ResetMap& map);
  void commit();

  // instant_reading.hpp
  void read_again();
  bool read_relation(const GuardGroup& group, Index slot);
  bool reads_changed(int node) const;
  /// [s] shorter flights drown in the rounding of the time.
  double least_time() const { return 64.0 * std::numeric_limits<double>::epsilon() * std::abs(t_); }
  void find_next();
  void look_at_held(const GuardGroup& group, std::size_t slot);
  [[noreturn]] void throw_no_end() const;
  const std::string& name_of(int source) const;

  // instant_arming.hpp
  void arm(bool at_start);
  void arm_crossing(const GuardGroup& group, std::size_t slot, bool at_start);
  void arm_relation(const GuardGroup& group, std::size_t slot);
  void arm_held(const GuardGroup& group, std::size_t slot);
  Departure::Side side_of(const GuardGroup& group, Index slot, double hair, int expected);
  bool rests(const GuardGroup& group, Index slot, int from);
  bool turned_round(const GuardGroup& group, int side);
  void hold(int leaf, ZenoMonitor& monitor, int source, double predicted);
  bool sets_off(int node) const;
  bool hold_edges_of(int node);
  void release(int leaf, ZenoMonitor& monitor, int source);

  // shared
  const Plan& plan() const { return machine_->plan(); }
  const PlanLeaf& leaf(int i) const { return plan().leaves[static_cast<std::size_t>(i)]; }
  const ZeroCrossing& crossing_of(const GuardGroup& group) const {
    return leaf(group.leaf).declared().zero_crossings[static_cast<std::size_t>(group.index)];
  }
  const EdgeReset& reset_of(const EdgeWatch& edge) const {
    return leaf(edge.leaf).declared().edge_resets[static_cast<std::size_t>(edge.index)];
  }
  int source_of(Cause cause, int index) const {
    const auto groups = static_cast<int>(plan().guards.size()),
               edges = static_cast<int>(plan().edges.size());
    return cause == Cause::crossing ? index
           : cause == Cause::edge   ? groups + index
                                    : groups + edges + index;
  }
  void log(EventKind kind, int source, int leaf_index, int direction,
           double predicted = std::numeric_limits<double>::quiet_NaN());
  void select_guards();
  bool held_outputs_changed() const;
  bool changed(const Place& place) const;

  Machine* machine_;
  Watch* watch_;
  const SimulatorOptions* options_;
  Results* results_;
  Recorder* recorder_ = nullptr;
  Departure departure_;

  std::vector<int> group_of_slot_;
  std::vector<ZenoMonitor> slot_monitors_, edge_monitors_;
  std::vector<char> edge_values_, carried_;

  double t_ = 0.0, longest_ = 0.0;
  int jump_ = 0, pass_ = 0;
  int event_jump_ = 0;  // of the events logged now
  Outcome outcome_;
  std::vector<Firing> firings_;  // for the pass to come
  std::vector<Action> actions_;
  std::vector<char> fired_, fired_now_;  // slots: in this instant, in this pass
  std::vector<char> was_active_;         // slots: for select_guards
  std::vector<char> frozen_,
      resting_;  // slots of relations: their side is kept in this instant, through the hold
  std::vector<signed char> from_;  // slots: the side the last crossing came from
  std::vector<int> edges_fired_;   // in this instant
  bool wrote_ = false,
       wrote_x_ = false;  // some pass of this instant wrote states, continuous state
  bool entered_ = false;  // some pass of this instant entered a mode
  bool flowed_ = false;   // departure_ stands at the present (t, x)
  Eigen::VectorXd x_minus_, z_minus_, x_next_, z_next_, y_before_, flow_before_;
  std::vector<int> modes_next_, modes_before_;
  std::vector<double> g_, g_minus_;   // guards now, and what the location of a root left of them
  std::vector<std::int64_t> counts_;  // events of each source
  std::vector<int> chain_;            // sources of what happened in this instant
};

}  // namespace saltus

