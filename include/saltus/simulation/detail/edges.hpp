// Edges: the watched signals that reset blocks, and which of them fired.
#pragma once

#include <vector>

#include "saltus/model/continuation.hpp"
#include "saltus/plan/detail/machine.hpp"

namespace saltus {

/// The last value of each watched signal, and its events in this instant.
class Edges {
 public:
  explicit Edges(const Machine& machine);

  /// A run begins with the present values.
  void begin();
  /// An instant begins: nothing has fired yet.
  void open();
  /// The signals were last looked at before the instant.
  void undo() { values_ = values_minus_; }

  struct Look {
    bool now = false;    ///< the signal
    bool fires = false;  ///< it has the edge that triggers the reset
  };
  /// Looks at the signal of edge e, and remembers it.
  Look look(std::size_t e);
  void fired(std::size_t e) { fired_.push_back(static_cast<int>(e)); }
  /// The reset map of a block on hold was applied again in this instant.
  void carried(std::size_t e) { carried_[e] = 1; }
  bool is_carried(std::size_t e) const { return carried_[e] != 0; }

  /// The edges that fired in this instant.
  const std::vector<int>& fired() const noexcept { return fired_; }
  bool has_fired(std::size_t e) const;
  /// Whether a relation decided an edge that fired in this instant, and the signal still has the
  /// value that fired it.
  bool set_off_by(int node) const;

  const EdgeReset& reset_of(std::integral auto e) const {
    return machine_->plan().reset_of(edge(e));
  }

  /// Saves the last values, which a continued run needs.
  std::vector<int> save() const { return {values_.begin(), values_.end()}; }
  bool fits(const Continuation& from) const { return from.edges.size() == values_.size(); }
  void load(const Continuation& from);

 private:
  const EdgeWatch& edge(std::integral auto e) const { return machine_->plan().edges[e]; }

  const Machine* machine_;
  std::vector<char> values_, values_minus_, carried_;
  std::vector<int> fired_;
};

}  // namespace saltus
