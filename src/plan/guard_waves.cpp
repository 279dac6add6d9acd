#include "saltus/plan/detail/guard_waves.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "expressions.hpp"
#include "fusible.hpp"
#include "saltus/plan/detail/kept.hpp"
#include "saltus/plan/detail/leaf_function.hpp"
#include "saltus/plan/detail/needs.hpp"

namespace saltus {

namespace {

using tape::Op;

/// [nodes] that the expressions of all guards may need, for each signal and each group of guards: those of a
/// long chain of blocks with a guard each would have n squared. Guards behind that have no waves.
constexpr std::size_t part_room = 256;

struct Argument {
  tape::Node node;
  double period;
};

/// The argument of an operation that turns, or jumps back, with its period; nothing for others.
std::optional<Argument> argument_of(tape::Graph& graph, tape::Node node) {
  const tape::Expression e = graph[node];
  switch (e.op) {
    case Op::sin:
    case Op::cos:
      return Argument{e.operands[0], 2.0 * std::numbers::pi};
    case Op::tan:
      return Argument{e.operands[0], std::numbers::pi};
    case Op::floor:
    case Op::ceil:
    case Op::trunc:
    case Op::rint:
      return Argument{e.operands[0], 1.0};
    case Op::mod:
    case Op::fmod:
    case Op::floor_divide:
      return Argument{graph.binary(Op::div, e.operands[0], e.operands[1]), 1.0};
    default:
      return {};
  }
}

class WaveSearch {
 public:
  explicit WaveSearch(const Plan& plan)
      : plan_(plan),
        first_(plan.nodes.size(), detail::Expressions::variable),
        values_(plan, first_) {
    add_signals();
  }

  GuardWaves run() {
    room_ = part_room * (plan_.nodes.size() + plan_.guards.size());
    for (const GuardGroup& group : plan_.guards)
      if (group.follows_time == FollowsTime::yes && !group.is_opaque()) add(group);
    GuardWaves made;
    if (found_.empty()) return made;
    made.arguments.emplace(values_.graph(), arguments_);
    made.guards.emplace(values_.graph(), guards_);
    for (std::size_t k = 0; k < found_.size(); ++k) {
      const Found& each = found_[k];
      made.waves.push_back(
          {each.slot, made.guards->place(each.guard), made.arguments->place(k), each.period});
    }
    return made;
  }

 private:
  struct Found {
    std::size_t slot, guard;  // the place of the guard, and that among guards_
    double period;
  };

  /// The signals behind the guards as expressions, where they have some.
  void add_signals() {
    std::vector<int> roots;
    for (const GuardGroup& group : plan_.guards)
      if (group.follows_time == FollowsTime::yes) detail::append(roots, nodes_read(plan_, group));
    detail::Marks marks(plan_.nodes.size(), 0);
    detail::spread(plan_, roots, marks,
                   [](const Node& node) { return node.rate != Rate::continuous; });
    for (const int i : plan_.order) {
      const Node& node = plan_.node(i);
      if (!marks[i] || node.rate != Rate::continuous || node.view || node.relation) continue;
      if (detail::is_narrow(plan_.output_of(node).formula, node.place.size) &&
          are_known(node.needs))
        values_.compute(i);
    }
  }

  /// Whether signals are held, states, or have expressions.
  bool are_known(const std::vector<int>& nodes) const {
    return std::ranges::all_of(nodes, [&](int i) {
      const Node& node = plan_.node(i);
      return node.rate != Rate::continuous || node.view ||
             first_[i] != detail::Expressions::variable;
    });
  }

  void add(const GuardGroup& group) {
    const Formula& formula = group.is_crossing()
                                 ? plan_.crossing_of(group).formula
                                 : plan_.relation_of(plan_.node(group.index)).formula;
    if (!detail::is_narrow(formula, group.size) || !are_known(nodes_read(plan_, group))) return;
    const auto entries = values_.add(formula, group.leaf, group.size);
    const std::vector<tape::Node> guards(entries.begin(), entries.end());
    for (std::size_t k = 0; k < guards.size(); ++k)
      add(static_cast<std::size_t>(group.slot) + k, guards[k]);
  }

  void add(std::size_t slot, tape::Node guard) {
    const std::vector<Argument> arguments = arguments_in(guard);
    if (arguments.empty()) return;
    guards_.push_back(guard);
    for (const Argument& argument : arguments) {
      found_.push_back({slot, guards_.size() - 1, argument.period});
      arguments_.push_back(argument.node);
    }
  }

  /// The arguments, that follow the time, of the operations that an expression needs.
  std::vector<Argument> arguments_in(tape::Node guard) {
    tape::Graph& graph = values_.graph();
    find_timed();
    std::vector<Argument> found;
    for (const int id : part_of(guard)) {
      if (!timed_[id]) continue;
      if (const auto argument = argument_of(graph, {id})) found.push_back(*argument);
    }
    return found;
  }

  /// The nodes that an expression needs; none where the room is used up.
  std::vector<int> part_of(tape::Node guard) {
    const tape::Graph& graph = values_.graph();
    seen_.resize(graph.size(), 0);
    std::vector<int> part{guard.id};
    seen_[guard.id] = ++search_;
    for (std::size_t next = 0; next < part.size(); ++next) {
      if (room_-- == 0) return room_ = 0, std::vector<int>();
      const tape::Expression& e = graph[{part[next]}];
      for (int k = 0; k < tape::operand_count(e.op); ++k)
        if (std::exchange(seen_[nth(e, k)], search_) != search_) part.push_back(nth(e, k));
    }
    return part;
  }

  /// Whether nodes follow the time, for those that are new.
  void find_timed() {
    const tape::Graph& graph = values_.graph();
    for (int id = static_cast<int>(timed_.size()); id < graph.size(); ++id) {
      const tape::Expression& e = graph[{id}];
      char timed = e.op == Op::time;
      for (int k = 0; k < tape::operand_count(e.op); ++k) timed = timed || timed_[nth(e, k)];
      timed_.push_back(timed);
    }
  }

  static int nth(const tape::Expression& e, int k) {
    return e.operands[static_cast<std::size_t>(k)].id;
  }

  const Plan& plan_;
  List<int> first_;
  detail::Expressions values_;
  std::vector<tape::Node> guards_, arguments_;
  std::vector<Found> found_;  // one for each argument
  List<char> timed_;          // whether a node follows the time
  List<int> seen_;            // the last search that saw a node
  int search_ = 0;
  std::size_t room_ = 0;  // nodes that the searches may see yet
};

}  // namespace

std::shared_ptr<const GuardWaves> guard_waves(const Plan& plan) {
  return plan.waves->get([&] { return WaveSearch(plan).run(); });
}

}  // namespace saltus
