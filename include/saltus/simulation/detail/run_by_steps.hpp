// RunBySteps: a run of an island that gets events of other islands, step by step.
#pragma once

#include <optional>

#include "saltus/simulation/detail/run.hpp"

namespace saltus {

/// The run takes a step, which counts only once it is known what arrives in it. The step has the length that
/// the method chooses; what arrives inside cuts it by its dense output, as a root does. So the bits of the
/// island depend on what arrives, and not on when that became known.
class RunBySteps : public Run {
 public:
  using Run::Run;

  void initialize(const Context& context) { Run::initialize(context), taken_.reset(); }
  /// Begins to run to t_end [s]: the instant at the start, and the first step.
  void begin_piece(double t_end);
  /// [s] The time at which the step that was taken ends, or is cut by what arrives; infinite if
  /// there is none: the end is reached, or the run is over.
  double next() const noexcept;
  /// Runs while `next` is before `safe` [s], and not after `latest` [s]. All that arrives before
  /// `safe` is known.
  void run_window(double safe, double latest);
  /// Ends the piece at t [s], before its end, by the dense output of the step that was taken.
  void cut_at(double t);
  /// Completes the results.
  void end_piece() { finish(); }
  /// What event wires bring from other islands, and take to them.
  OutsideWires& outside() noexcept { return instant_.queues().outside(); }
  /// Whether the run has ended before the end of the piece.
  bool over() const noexcept { return over_ || results_.status == Status::failed; }

 private:
  /// A step that was taken and does not count yet.
  struct Taken {
    double to;  ///< [s] its end
    StopReason reason;
    double t_stop;        ///< [s]
    bool failed = false;  ///< nothing was taken: it failed, maybe beyond what arrives
  };
  void commit(double safe);
  Status take_step();
  Status commit_step(double safe);
  StopReason step_again(double& to, double t_stop);

  std::optional<Taken> taken_;
  double t_end_ = 0.0;  // [s] of the piece
};

}  // namespace saltus
