// Recorder: appends rows to the columns of the results. It exists only if something is recorded,
// and it changes no bit of the run.
#pragma once

#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

class Tangents;

class Recorder {
 public:
  /// `only` is a list of increasing times. With it there is one row at each of these times, the
  /// last of several, and no other row.
  /// `tangents`, if not null, differentiates each row.
  Recorder(Machine& machine, Results& results, const std::vector<double>* only = nullptr,
           Tangents* tangents = nullptr)
      : machine_(&machine), results_(&results), only_(only), tangents_(tangents) {
    results.signals.clear();
    for (const Tap& tap : machine.plan().taps) {
      results.signals.push_back({tap.name, machine.plan().node(tap.node).shape, {}});
    }
  }

  /// Appends a row at (t, j) of the state x.
  void record(double t, int jump, const double* x) {
    if (only_ != nullptr && !asked_for(t)) return;
    const Values values = machine_->evaluate_taps(t, x);
    const auto& taps = machine_->plan().taps;
    for (const Tap& tap : taps) {
      const Place& place = machine_->plan().node(tap.node).place;
      if (!VectorView(values(place), place.size).allFinite()) throw_not_finite(t, tap);
    }
    if (only_ != nullptr && !results_->time.empty() && results_->time.back() == t) drop();
    results_->time.push_back(t);
    results_->jump.push_back(jump);
    for (std::size_t i = 0; i < taps.size(); ++i) {
      const Place& place = machine_->plan().node(taps[i].node).place;
      const double* value = values(place);
      results_->signals[i].values.insert(results_->signals[i].values.end(), value,
                                         value + place.size);
    }
    if (tangents_ != nullptr) differentiate(t, x);
  }

  /// Records a row, and replaces a row at (t, j) that is there already.
  void replace(double t, int jump, const double* x) {
    if (has_row(t, jump)) drop();
    record(t, jump, x);
  }

  /// Removes all rows but the first n.
  void shorten(std::size_t n) {
    while (results_->time.size() > n) drop();
  }

  bool has_row(double t, int jump) const {
    return !results_->time.empty() && results_->time.back() == t && results_->jump.back() == jump;
  }

 private:
  /// Removes the last row.
  void drop() {
    if (tangents_ != nullptr) drop_tangents();
    results_->time.pop_back();
    results_->jump.pop_back();
    for (auto& signal : results_->signals) {
      signal.values.resize(signal.values.size() - static_cast<std::size_t>(signal.shape.size));
    }
  }

  void differentiate(double t, const double* x);
  void drop_tangents();

  /// Time never decreases, so one pass through the list is enough.
  bool asked_for(double t) {
    while (next_ < only_->size() && (*only_)[next_] < t) ++next_;
    return next_ < only_->size() && (*only_)[next_] == t;
  }

  [[noreturn]] void throw_not_finite(double t, const Tap& tap) const {
    const Node& node = machine_->plan().node(tap.node);
    throw SimulationError(
        text("t = ", t, " s: output '", machine_->plan().name_of(node), "', recorded as '",
             tap.name, "', is not finite (NaN or Inf); check it at this time"),
        t, machine_->plan().leaf_of(node).path);
  }

  Machine* machine_;
  Results* results_;
  const std::vector<double>* only_;
  Tangents* tangents_;
  std::size_t next_ = 0;
};

}  // namespace saltus
