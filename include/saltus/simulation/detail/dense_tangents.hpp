// DenseTangents: the derivatives of a run with dense output, step by step.
#pragma once

#include <vector>

#include "saltus/simulation/detail/tangent_probe.hpp"
#include "saltus/simulation/options.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {

/// Writes the trajectory of the derivatives, with the sizes and the states at rest that belong to it.
/// Without dense output it writes nothing.
class DenseTangents {
 public:
  DenseTangents(const Machine& machine, const SimulatorOptions& options, const TangentProbe& probe,
                Results& results)
      : machine_(&machine), probe_(&probe), results_(&results), asked_(options.dense_output) {}

  bool asked() const noexcept { return asked_; }

  /// The trajectory begins at t [s].
  void open(double t, const TangentColumns& columns) {
    if (asked_) to().open(t, columns, machine_->resting(), probe_->sizes());
  }
  /// Adds a step [s] with these pieces, at the end of which are these columns.
  void add(double from, double end, const std::vector<Variation::Piece>& pieces,
           const TangentColumns& columns) {
    to().add(from, end, pieces, columns, machine_->resting(), probe_->sizes());
  }
  /// An instant is over.
  void instant() {
    if (asked_) to().instant(probe_->sizes());
  }
  /// The run ends at t [s].
  void close(double t, const TangentColumns& columns) {
    if (asked_)
      to().close(t, columns, machine_->resting(), probe_->sizes(),
                 results_->status != Status::failed);
  }

 private:
  TangentTrajectory& to() noexcept { return results_->sensitivities.trajectory; }

  const Machine* machine_;
  const TangentProbe* probe_;
  Results* results_;
  bool asked_;
};

}  // namespace saltus
