// Feedthrough order: each node follows the nodes it needs; an algebraic loop is reported as its
// path.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/model/detail/wiring_errors.hpp"

namespace saltus::detail {

/// Depth-first topological order of the nodes 0 ... count - 1. `needs(i)` gives the nodes that node
/// i needs, as a span or a vector; `name(i)` names it in the error of a loop.
template <class Needs, class Name>
class FeedthroughOrder {
 public:
  FeedthroughOrder(std::size_t count, Needs needs, Name name)
      : needs_(std::move(needs)), name_(std::move(name)), mark_(count, Mark::fresh) {}

  /// Throws a ModelError with the path of the loop if there is one.
  std::vector<int> run() {
    order_.reserve(mark_.size());
    for (std::size_t i = 0; i < mark_.size(); ++i) {
      enter(static_cast<int>(i));
      while (!path_.empty()) go_on();
    }
    return std::move(order_);
  }

 private:
  enum class Mark : char { fresh, open, done };
  struct Open {
    int node;
    decltype(std::declval<Needs>()(0)) needs;
    std::size_t next = 0;  // the next of the nodes it needs
  };

  void enter(int i) {
    Mark& mark = mark_[i];
    if (mark == Mark::done) return;
    if (mark == Mark::open) throw_loop(i);
    mark = Mark::open;
    path_.push_back({i, needs_(i)});
  }

  /// Continues with the last node of the path: goes to the next node it needs, or finishes it.
  void go_on() {
    Open& last = path_.back();
    if (last.next < last.needs.size()) return enter(last.needs[last.next++]);
    mark_[last.node] = Mark::done;
    order_.push_back(last.node);
    path_.pop_back();
  }

  [[noreturn]] void throw_loop(int start) const {
    std::vector<std::string> loop;
    for (auto it = std::ranges::find(path_, start, &Open::node); it != path_.end(); ++it)
      loop.push_back(name_(it->node));
    throw_algebraic_loop(loop);
  }

  Needs needs_;
  Name name_;
  List<Mark> mark_;
  std::vector<Open> path_;  // from reader to read node
  std::vector<int> order_;
};

}  // namespace saltus::detail
