// Plan: a system compiled to flat lists. It is structure only, never changes after compile(), and
// threads share it.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/model/diagram.hpp"
#include "saltus/plan/event_wires.hpp"
#include "saltus/plan/rate.hpp"

namespace saltus {

template <class T>
class Kept;
struct FlowSeries;
struct FlowDivisors;
struct GuardWaves;

/// An output or a relation: a value that other nodes read.
struct Node {
  int leaf = -1;
  int index = -1;  // the number of the output or the relation within its leaf
  bool relation = false;
  bool boolean = false;
  Shape shape = {};
  bool shaped = false;  // its shape is known
  // The place of its value; a view of a state or a parameter has no place of its own.
  Place place = {};
  bool view = false;
  std::vector<int> needs = {};  // the nodes it reads when it is computed
  Rate rate = Rate::constant;
  bool located = false;  // a relation, or an opaque boolean, that is held between instants
  bool used = false;     // some node or leaf reads it

  bool opaque() const { return located && !relation; }
};

struct PlanLeaf {
  const LeafSystem* system = nullptr;
  std::string path = {};
  Index x = 0, nx = 0, z = 0, nz = 0, p = 0, np = 0;
  List<int> inputs = {};  // the node that feeds each input
  List<Place> input_places = {};
  bool receives = false;  ///< event wires lead to it
  /// Its inputs and the weight of a delivery, if it receives.
  List<Place> delivery_places = {};
  List<int> outputs = {};    // the node of each output
  List<int> relations = {};  // the node of each relation
  /// The declarations of the system, or the declarations with which a Refinement replaced them.
  std::shared_ptr<const Declarations> declarations = {};

  const Declarations& declared() const { return *declarations; }
};

/// A value that a guard reads, beside the guards in the vector of looks.
struct ReadSlot {
  Index slot = 0;
  Place place = {};  // one entry of a continuous signal
  int node = -1;     // the signal
};

/// A vector of guards that one call computes.
struct GuardGroup {
  enum class Kind { crossing, relation, opaque };
  Kind kind = Kind::crossing;
  int leaf = -1;
  int index = -1;  // the zero crossing of the leaf, or the node
  Index slot = 0;  // its first place in the vector of all guards
  Index size = 1;
  Direction direction = Direction::crosses_zero;
  bool monitor = false;
  bool queued = false;             // its firing is a trigger of an execution
  bool sends = false;              // event wires start from it
  std::string name = {};           // "block.guard"
  List<int> leaves = {};           // the blocks whose continuous state changes it
  std::vector<int> controls = {};  // nodes: it is seen while all of them are true
  List<ReadSlot> reads = {};       // values that may vary while it is constant
  bool stepped = false;            // it may be constant while what it reads varies
  FollowsTime follows_time = FollowsTime::no;
  bool turns = false;  // its formula, or one behind it, has a sine or the like of a state

  bool is_crossing() const { return kind == Kind::crossing; }
  bool is_opaque() const { return kind == Kind::opaque; }
};

/// A held signal with a reset at its edge.
struct EdgeWatch {
  int leaf = -1;
  int index = -1;               // edge reset of the leaf
  int node = -1;                // the signal
  List<int> relations = {};     // located nodes that decide it
  std::vector<int> reads = {};  // nodes its reset map reads
  std::string name = {};        // "block.reset"
};

struct ScheduledEvent {
  int leaf = -1;
  int index = -1;  // time event of the leaf
  double period = 0.0, offset = 0.0;
  std::string name = {};
  std::int64_t ticks = std::numeric_limits<std::int64_t>::max();
  List<double> times = {};  // of its ticks, in place of period and offset
  bool by_state = false;    // the discrete state of the leaf decides the ticks
};

struct Tap {
  std::string name = {};
  int node = -1;
};

/// A list of nodes in the form that the machine executes, followed by its sinks: the odes or the
/// guards. Formulas that feed one another are one function over all of the machine's memory, which
/// stores only the values that other nodes read. All other nodes are calls in between.
struct Walk {
  struct Stage {
    VectorFunction fused = {};  // writes to `y`; empty without formulas
    std::vector<int> calls = {};
  };
  List<Stage> stages = {};
  VectorFunction last = {};  // writes to `xdot` or the guards; empty if nothing is fused
  List<int> nodes = {};      // nodes that no longer have a call
  List<char> fused = {};     // for each ode or group of guards: whether `last` has it

  bool fuses() const { return last || !nodes.empty(); }
};

/// The nodes to compute at each occasion. Each list is a part of Plan::order, and no other node is
/// ever computed.
struct Needs {
  std::vector<int> constants;  ///< once, at run start
  std::vector<int> instants;   ///< at instants: held outputs, and what resets, updates, edges read
  std::vector<int> derivatives;  ///< before the odes
  std::vector<int> guards;       ///< before the guards
  std::vector<int> taps;         ///< before a row is recorded
  std::vector<int> histories;    ///< after a step, for the leaves that keep a history
  /// Held nodes that the derivatives read: if one changes, the solver restarts.
  std::vector<int> restarting;
};

struct Plan {
  List<PlanLeaf> leaves;
  List<Node> nodes;
  std::vector<int> order;  // all nodes, each after the nodes it needs
  Needs needs;

  std::vector<int> odes;  // leaves with a continuous state
  List<GuardGroup> guards;
  List<EdgeWatch> edges;
  bool reads_before = false;  // some of their resets read the inputs before the instant
  List<ScheduledEvent> schedule;
  EventWires event_wires;
  std::vector<Tap> taps;
  std::vector<int> histories;  // leaves that keep a history
  std::vector<int> checked;    // leaves with parameter checks
  std::vector<int> starting;   // leaves with start checks
  std::vector<int> controls;   // nodes: the control signals of leaves with guards
  struct {
    Walk derivatives, guards;
  } walks;  // derivatives with odes, and what guards need with the guards

  Index nx = 0, nz = 0, np = 0, ny = 0, guard_slots = 0;
  std::shared_ptr<const ComputedParameters> computed = {};  ///< null if there are none
  Index look_slots = 0;  // the guards, and behind them the values of their ReadSlots

  // These are made later than the plan, when somebody first needs them.
  std::shared_ptr<Kept<FlowSeries>> series;      ///< for the method `taylor`
  std::shared_ptr<Kept<FlowDivisors>> divisors;  ///< for the search for poles
  std::shared_ptr<Kept<GuardWaves>> waves;       ///< for the looks at guards

  /// Says what was kept, folded and dropped, and why, with one line for each fact.
  std::string describe() const;

  /// "block.port"
  std::string name_of(const Node& node) const {
    const std::string& port = node.relation ? relation_of(node).name : output_of(node).name;
    return text(leaf_of(node).path, ".", port);
  }

  // The lists by number, of any integer type.
  const Node& node(std::integral auto i) const { return nodes[i]; }
  const PlanLeaf& leaf(std::integral auto i) const { return leaves[i]; }
  const GuardGroup& guard(std::integral auto i) const { return guards[i]; }
  const EdgeWatch& edge(std::integral auto i) const { return edges[i]; }
  const ScheduledEvent& scheduled(std::integral auto i) const { return schedule[i]; }

  // The declarations of which the entries of the lists were made.
  const PlanLeaf& leaf_of(const Node& node) const { return leaf(node.leaf); }
  const OutputDeclaration& output_of(const Node& node) const {
    return leaf_of(node).declared().outputs[node.index];
  }
  const Relation& relation_of(const Node& node) const {
    return leaf_of(node).declared().relations[node.index];
  }
  /// The declaration of a group of zero crossings.
  const ZeroCrossing& crossing_of(const GuardGroup& group) const {
    return leaf(group.leaf).declared().zero_crossings[group.index];
  }
  /// The mode in which a group of guards is seen; none for relations.
  std::optional<int> start_mode_of(const GuardGroup& group) const {
    return group.is_crossing() ? crossing_of(group).start_mode : std::nullopt;
  }
  const EdgeReset& reset_of(const EdgeWatch& edge) const {
    return leaf(edge.leaf).declared().edge_resets[edge.index];
  }
  const TimeEvent& time_event_of(const ScheduledEvent& event) const {
    return leaf(event.leaf).declared().time_events[event.index];
  }
};

/// The signals to record, with names that the user chooses.
using RecordedSignals = std::vector<std::pair<std::string, OutputPort>>;

}  // namespace saltus
