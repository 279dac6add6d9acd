// Feedthrough order: each node follows the nodes it needs; an algebraic loop is reported as its
// path.
#pragma once

#include "saltus/model/detail/wiring_errors.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// Depth-first topological order. A located relation is held, so it needs nothing and breaks loops.
class Ordering {
 public:
  explicit Ordering(const Plan& plan) : plan_(plan), mark_(plan.nodes.size(), Mark::fresh) {}

  std::vector<int> run() {
    order_.reserve(plan_.nodes.size());
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      enter(static_cast<int>(i));
      while (!path_.empty()) go_on();
    }
    return std::move(order_);
  }

 private:
  enum class Mark : char { fresh, open, done };
  struct Open {
    int node;
    std::size_t next;  // the next of the nodes it needs
  };

  void enter(int i) {
    Mark& mark = mark_[static_cast<std::size_t>(i)];
    if (mark == Mark::done) return;
    if (mark == Mark::open) throw_loop(i);
    mark = Mark::open;
    path_.push_back({i, 0});
  }

  /// Continues with the last node of the path: goes to the next node it needs, or finishes it.
  void go_on() {
    Open& last = path_.back();
    const Node& node = plan_.node(last.node);
    if (!(node.relation && node.located) && last.next < node.needs.size())
      return enter(node.needs[last.next++]);
    mark_[static_cast<std::size_t>(last.node)] = Mark::done;
    order_.push_back(last.node);
    path_.pop_back();
  }

  [[noreturn]] void throw_loop(int start) const {
    std::vector<std::string> loop;
    for (auto it = std::ranges::find(path_, start, &Open::node); it != path_.end(); ++it)
      loop.push_back(plan_.name_of(plan_.node(it->node)));
    throw_algebraic_loop(loop);
  }

  const Plan& plan_;
  std::vector<Mark> mark_;
  std::vector<Open> path_;  // from reader to read node
  std::vector<int> order_;
};

inline void add_order(Plan& plan) { plan.order = Ordering(plan).run(); }

}  // namespace saltus::detail
