// Plan: a system compiled to flat lists. Structure only, immutable after compile(), shared by
// threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "saltus/model/diagram.hpp"
#include "saltus/plan/rate.hpp"

namespace saltus {

/// An output or a relation: one value that others read.
struct Node {
  int leaf = -1;
  int index = -1;  // of the output or the relation within its leaf
  bool relation = false;
  bool boolean = false;
  Shape shape = {};
  bool shaped = false;  // the shape is known
  Place place =
      {};  // where its value lives; a view of a state or a parameter has no place of its own
  bool view = false;
  std::vector<int> needs = {};  // nodes read when it is computed
  Rate rate = Rate::constant;
  bool located = false;  // a relation, or an opaque boolean, that is held between instants
  bool used = false;     // somebody reads it

  bool opaque() const { return located && !relation; }
};

struct PlanLeaf {
  const LeafSystem* system = nullptr;
  std::string path = {};
  Index x = 0, nx = 0, z = 0, nz = 0, p = 0, np = 0;
  std::vector<int> inputs = {};  // node behind each input
  std::vector<Place> input_places = {};
  std::vector<int> outputs = {};    // node of each output
  std::vector<int> relations = {};  // node of each relation

  const Declarations& declared() const { return system->declarations(); }
};

/// One vector of guards that is computed by one call.
struct GuardGroup {
  enum class Kind { crossing, relation, opaque };
  Kind kind = Kind::crossing;
  int leaf = -1;
  int index = -1;  // zero crossing of the leaf; else the node
  Index slot = 0;  // first of its places in the vector of all guards
  Index size = 1;
  Direction direction = Direction::crosses_zero;
  bool monitor = false;
  std::string name = {};         // "block.guard"
  std::vector<int> leaves = {};  // blocks whose continuous state moves it
};

/// A watched held signal with a reset behind it.
struct EdgeWatch {
  int leaf = -1;
  int index = -1;                   // edge reset of the leaf
  int node = -1;                    // the watched signal
  std::vector<int> relations = {};  // located nodes that decide it
  std::vector<int> reads = {};      // nodes its reset map reads
  std::string name = {};            // "block.reset"
};

struct ScheduledEvent {
  int leaf = -1;
  int index = -1;  // time event of the leaf
  double period = 0.0, offset = 0.0;
  std::string name = {};
};

struct Tap {
  std::string name = {};
  int node = -1;
};

/// A list of nodes as it is carried out, with what it is for: the odes, or the guards. Formulas
/// that feed one another are one function over all of the machine's memory, which writes down only
/// what others read; the rest are calls in between.
struct Walk {
  struct Stage {
    VectorFunction fused = {};  // into `y`; empty: nothing
    std::vector<int> calls = {};
  };
  std::vector<Stage> stages = {};
  VectorFunction last = {};      // into `xdot`, or the vector of guards; empty: nothing was fused
  std::vector<int> nodes = {};   // that have no call any more
  std::vector<char> fused = {};  // of each ode, or group of guards: it is in `last`

  bool fuses() const { return last || !nodes.empty(); }
};

struct Plan {
  std::vector<PlanLeaf> leaves;
  std::vector<Node> nodes;
  std::vector<int> order;  // all nodes, each after what it needs

  // What is computed when. Each list is a part of `order`; nothing else is ever computed.
  std::vector<int> constants;  // once, at run start
  std::vector<int> instants;   // at instants: held outputs, and what resets, updates and edges read
  std::vector<int> derivatives;  // before the odes
  std::vector<int> guard_needs;  // before the guards
  std::vector<int> tap_needs;    // before a row is recorded
  std::vector<int>
      restarting;  // held nodes the derivatives read: if one changes, the solver restarts

  std::vector<int> odes;  // leaves with a continuous state
  std::vector<GuardGroup> guards;
  std::vector<EdgeWatch> edges;
  std::vector<ScheduledEvent> schedule;
  std::vector<Tap> taps;
  Walk derivative_walk, guard_walk;  // of derivatives with odes, and of guard_needs with guards

  Index nx = 0, nz = 0, np = 0, ny = 0, guard_slots = 0;

  /// What was kept, folded and dropped, and why; one line a fact.
  std::string describe() const;

  /// "block.port"
  std::string name_of(const Node& node) const {
    const std::string& port = node.relation ? relation_of(node).name : output_of(node).name;
    return text(leaf_of(node).path, ".", port);
  }
  const PlanLeaf& leaf_of(const Node& node) const {
    return leaves[static_cast<std::size_t>(node.leaf)];
  }
  const Node& node(int i) const { return nodes[static_cast<std::size_t>(i)]; }
  const OutputDeclaration& output_of(const Node& node) const {
    return leaf_of(node).declared().outputs[static_cast<std::size_t>(node.index)];
  }
  const Relation& relation_of(const Node& node) const {
    return leaf_of(node).declared().relations[static_cast<std::size_t>(node.index)];
  }
};

/// A signal to record, under a name of the user's choice.
using RecordedSignals = std::vector<std::pair<std::string, OutputPort>>;

}  // namespace saltus
