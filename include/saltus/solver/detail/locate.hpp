// Location: the earliest crossing of any guard inside one solver step.
#pragma once

#include "saltus/solver/detail/guard_search.hpp"

namespace saltus {

/// Searches a step for guards that stop the solver as if there were no monitors, because no monitor
/// may change a bit of a root. The monitors are then searched up to that root.
class Locator {
 public:
  using Part = GuardSearch::Part;

  Locator(Machine& machine, GuardSet& guards)
      : guards_(&guards),
        stopping_(machine, guards, guards.active().stopping),
        watching_(machine, guards, guards.active().monitors) {}
  Locator(const Locator&) = delete;  // only_ points into it
  Locator& operator=(const Locator&) = delete;

  /// Finds the first offset at which the solver has to stop; false if there is none. If a look
  /// throws, the guards are as before.
  template <class Interpolate>
  bool find(const Part& step, const Interpolate& interpolate) {
    guards_->begin_search();
    try {
      return find_both(step, interpolate);
    } catch (...) {
      guards_->restore();
      throw;
    }
  }

  /// `find` for a whole step, of this length and with this state at its end, in a short form: true
  /// if no guard fires in it, as in most steps; false if `find` has to decide.
  [[gnu::always_inline]] bool passes(double t0, double length, const double* end) {
    if (only_ == nullptr) return false;
    guards_->begin_search();
    return only_->passes(t0, length, end);
  }

  void begin_run() { stopping_.begin_run(), watching_.begin_run(); }
  /// Forgets the looks before a restart, which have no meaning after it.
  void forget() { stopping_.forget(), watching_.forget(); }

  /// Keeps what the looks so far have taught, and forgets what was learnt since.
  void keep() { stopping_.keep(), watching_.keep(); }
  void restore() { stopping_.restore(), watching_.restore(), forget(); }
  /// The step ends at a stop, and no guard fired in it: see GuardSet::beside_stop.
  void note_beside_stop() { stopping_.note_beside_stop(), watching_.note_beside_stop(); }
  /// The step ends at a stop, but it was searched to a root only, there or shortly before: each guard may
  /// be at zero.
  void pass_to_stop() {
    forget();
    guards_->beside_stop = guards_->active().all;
  }

  double offset() const noexcept { return stopping_.offset(); }

 private:
  template <class Interpolate>
  bool find_both(const Part& step, const Interpolate& interpolate) {
    const bool stops = stopping_.has_guards() && stopping_.find(step, interpolate);
    if (watching_.has_guards()) watch(step, stops, interpolate);
    only_ = !watching_.has_guards() ? &stopping_ : !stopping_.has_guards() ? &watching_ : nullptr;
    if (!stops || offset() == step.to) stopping_.end_step(step.to), watching_.end_step(step.to);
    return stops;
  }

  template <class Interpolate>
  void watch(Part step, bool stops, const Interpolate& interpolate) {
    step.to_root = stops;
    if (stops && offset() < step.to) {
      step.to = offset();
      step.end = step.guards = nullptr;
    }
    watching_.find(step, interpolate);
  }

  GuardSet* guards_;
  GuardSearch stopping_, watching_;
  GuardSearch* only_ = nullptr;  // the search with guards, if there is one of them
};

}  // namespace saltus
