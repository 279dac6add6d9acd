// TangentRows: the derivatives of the recorded signals, and of the final state, in the results.
#pragma once

#include <string>
#include <vector>

#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// Writes `Sensitivities::signals`, `continuous_state` and `discrete_state`.
class TangentRows {
 public:
  TangentRows(const Machine& machine, const SimulatorOptions& options, TangentProbe& probe,
              TangentGaps& gaps, Results& results)
      : machine_(&machine), options_(&options), probe_(&probe), gaps_(&gaps), results_(&results) {}

  /// A run with the derivatives by these parameters begins.
  void begin(std::vector<std::string> parameters);
  /// The results were moved out: the rows to come are of new ones.
  void renew() { begin(names_); }

  /// Adds a row at (t, x) with these derivatives at a fixed time.
  void add(double t, const double* x, const TangentColumns& at, const OneSided& one_sided,
           const AtJump& jump);
  /// Takes the last row away.
  void drop();
  /// The run ends at t with these derivatives. Those that are one-sided at a regular end are no more.
  void finish(double t, TangentColumns at, const OneSided& one_sided, const AtJump& jump);

 private:
  const Machine* machine_;
  const SimulatorOptions* options_;
  TangentProbe* probe_;
  TangentGaps* gaps_;
  Results* results_;
  std::vector<std::string> names_;
};

}  // namespace saltus
