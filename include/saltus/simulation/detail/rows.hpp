// Rows: the rows that a run records between instants. The rows of an instant are in
// instant_rows.hpp.
#pragma once

#include <cstddef>
#include <optional>

#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/recorder.hpp"

namespace saltus {

/// Records the ends of steps and the times that the user asked for. Without recorded signals it
/// does nothing.
class Rows {
 public:
  Rows(Machine& machine, Results& results, const SimulatorOptions& options)
      : machine_(&machine), results_(&results), options_(&options) {}

  /// From the next columns on `tangents` differentiates each row.
  void follow(Tangents* tangents) { tangents_ = tangents; }
  /// A run begins, with empty columns.
  void begin();
  /// New columns, because the old ones have been moved out with the results.
  void renew();
  /// Null: nothing is recorded.
  Recorder* recorder() { return recorder_ ? &*recorder_ : nullptr; }
  /// Records the state x at (t, jump), unless this row is there already.
  void record(double t, int jump, const double* x) {
    if (recorder_ && !recorder_->has_row(t, jump)) recorder_->record(t, jump, x);
  }
  /// Records the step from `from` to t: the rows at requested times, then the row at its end.
  void record_step(double from, double t, int jump, Integration& integration) {
    if (recorder_) record_rows(from, t, jump, integration);
  }
  /// Removes all rows but the first n.
  void shorten(std::size_t n) {
    if (recorder_) recorder_->shorten(n);
  }

 private:
  void record_rows(double from, double t, int jump, Integration& integration);

  Machine* machine_;
  Results* results_;
  const SimulatorOptions* options_;
  Tangents* tangents_ = nullptr;
  std::optional<Recorder> recorder_;
  std::size_t next_ = 0;  // of the requested times
};

}  // namespace saltus
