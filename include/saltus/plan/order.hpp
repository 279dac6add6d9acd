// Feedthrough order: every node after what it needs; an algebraic loop is reported as the path it
// is.
#pragma once

#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// Depth-first topological order. A located relation is held, so it needs nothing and breaks loops.
class Ordering {
 public:
  explicit Ordering(const Plan& plan) : plan_(plan), mark_(plan.nodes.size(), Mark::fresh) {}

  std::vector<int> run() {
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) visit(static_cast<int>(i));
    return std::move(order_);
  }

 private:
  enum class Mark : char { fresh, open, done };

  void visit(int i) {
    Mark& mark = mark_[static_cast<std::size_t>(i)];
    if (mark == Mark::done) return;
    if (mark == Mark::open) throw_loop(i);
    mark = Mark::open;
    path_.push_back(i);
    const Node& node = plan_.node(i);
    if (!(node.relation && node.located)) {
      for (int need : node.needs) visit(need);
    }
    path_.pop_back();
    mark = Mark::done;
    order_.push_back(i);
  }

  [[noreturn]] void throw_loop(int start) const {
    // path_ runs from reader to what it reads; the signal flows the other way round.
    const auto first = std::ranges::find(path_, start);
    std::string message = "algebraic loop: each output depends on the next at the same time\n";
    for (auto it = first; it != path_.end(); ++it)
      message += text("  '", plan_.node(*it).name, "' reads\n");
    message += text("  '", plan_.node(start).name,
                    "'\nput a block without feedthrough into the loop (Integrator, UnitDelay), or "
                    "declare which "
                    "inputs an output does not read");
    throw ModelError(message);
  }

  const Plan& plan_;
  std::vector<Mark> mark_;
  std::vector<int> path_, order_;
};

inline void add_order(Plan& plan) { plan.order = Ordering(plan).run(); }

}  // namespace saltus::detail
