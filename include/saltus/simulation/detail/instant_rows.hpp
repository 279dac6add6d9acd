// Instant rows: one before each pass that changes something, one after it.
#pragma once

#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/detail/recorder.hpp"
#include "saltus/simulation/detail/scope.hpp"
#include "saltus/solver/detail/guard_set.hpp"

namespace saltus {

/// In the row before a pass the relations that fired have the side that their crossing says, and so
/// has what follows from them; everything else is x-. A trigger that fired is true in a row.
class InstantRows {
 public:
  InstantRows(const Scope& scope, Machine& machine, const GuardSet& guards, const Present& present)
      : scope_(&scope), machine_(&machine), guards_(&guards), present_(&present) {}

  /// A run begins. Null: nothing is recorded.
  void begin(Recorder* recorder) { recorder_ = recorder; }
  /// The row before the pass after jump `jump`. `flipped`: relations have fired in it.
  void before(int jump, bool flipped);
  /// The row after the pass that made the jump count `jump`.
  void after(int jump) {
    if (recorder_ != nullptr) recorder_->record(present_->t, jump, machine_->x.data());
  }

  /// The same row, where a block was put at rest on its surface since.
  void again(int jump) {
    if (recorder_ != nullptr && recorder_->has_row(present_->t, jump))
      recorder_->replace(present_->t, jump, machine_->x.data());
  }

 private:
  void follow_flips();
  void put_back_what_does_not_follow();

  const Scope* scope_;
  Machine* machine_;
  const GuardSet* guards_;
  const Present* present_;
  Recorder* recorder_ = nullptr;
  Eigen::VectorXd y_before_;  // signals before the instant
  List<char> follows_;        // of each node: from a relation that fired
};

}  // namespace saltus
