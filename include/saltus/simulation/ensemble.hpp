// Ensemble: many runs of one system that differ in values only, over one plan.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "saltus/model/context_entry.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

/// The execution of an ensemble. No option here changes a bit of any run.
struct EnsembleOptions {
  /// The number of threads; 0 for as many as the machine has cores. With 1 the calling thread makes
  /// all runs.
  int threads = 1;
  /// The calling thread calls it about every 50 ms with the number of finished runs. If it returns
  /// true the ensemble ends, and unfinished runs are interrupted.
  std::function<bool(Index done)> watch = {};
  /// Each further thread makes its part of the runs, `share`, within a call of this function.
  std::function<void(const std::function<void()>& share)> around = {};
};

/// Runs of a system from `base` over `span`, one for each row of the varied values. All threads
/// share one plan. Each thread reuses one machine, one simulator and one context: after the first
/// run of a thread a run allocates only its results. The system must outlive the ensemble.
///
///     Ensemble ensemble(ball, ball.create_context(), {0.0, 5.0});
///     ensemble.vary("e", {0.5, 0.7, 0.9});
///     ensemble.vary("x[0]", {10.0, 10.0, 20.0});
///     ensemble.run([&](Index run, const Results& results) { ... }, {.threads = 2});
class Ensemble {
 public:
  /// Takes the results of one run. The thread that made the run calls it, in no fixed order, and
  /// several threads may call it at once. An exception from it ends the ensemble and is rethrown by
  /// `run`.
  using Take = std::function<void(Index run, const Results& results)>;

  /// Throws ModelError as Simulator does, and for a span that ends before it begins.
  Ensemble(const System& system, Context base, TimeSpan span, SimulatorOptions options = {});

  /// Varies the parameter or state `name` (see ContextEntry): `width` entries of `values` for each
  /// run, run after run. Throws ModelError for an unknown name, a width that does not fit, another
  /// number of runs than before, and a name that is already varied.
  void vary(std::string_view name, std::vector<double> values, Index width = 1);

  Index size() const noexcept { return size_; }
  const Plan& plan() const noexcept { return *plan_; }
  const Context& base() const noexcept { return base_; }
  const TimeSpan& span() const noexcept { return span_; }
  /// The start values of a run. Throws ModelError if one of them is impossible.
  Context context(Index run) const;

  /// Makes all runs, and returns how many were made: all, unless `watch` ended the ensemble. A run
  /// that fails is passed to `take` with its status and message; the other runs continue.
  Index run(const Take& take, const EnsembleOptions& how = {}) const;

 private:
  struct Varied {
    std::string name;
    ContextEntry entry;
    std::size_t width;
    std::vector<double> values;
  };
  class Worker;
  struct Progress;

  void require_new(std::string_view name, const ContextEntry& entry) const;
  void write(Context& context, Index run) const;

  std::shared_ptr<const Plan> plan_;
  Context base_;
  TimeSpan span_;
  SimulatorOptions options_;
  std::vector<Varied> varied_;
  Index size_ = 1;  // nothing varied: one run
};

}  // namespace saltus
