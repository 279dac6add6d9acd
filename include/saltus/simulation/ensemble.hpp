// Ensemble: many runs of one system that differ in values only, over one plan.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "saltus/model/context_entry.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

/// How an ensemble is run. None of it changes a bit of any run.
struct EnsembleOptions {
  /// Threads that run it; 0 for as many as the machine has cores. With 1 the calling thread does
  /// it all.
  int threads = 1;
  /// Asked by the calling thread, about every 50 ms, with how many runs are done; true ends the
  /// ensemble, and what was under way is interrupted.
  std::function<bool(Index done)> watch = {};
  /// Each further thread does its share within a call of this, `share` being that share.
  std::function<void(const std::function<void()>& share)> around = {};
};

/// Runs of a system from `base` over `span`, one for each row of the varied values. One plan is
/// shared; each thread has one machine, one simulator and one context, used again and again: after
/// the first run of a thread a run asks for no memory but that of its results. The system has to
/// outlive it.
///
///     Ensemble ensemble(ball, ball.create_context(), {0.0, 5.0});
///     ensemble.vary("e", {0.5, 0.7, 0.9});
///     ensemble.vary("x[0]", {10.0, 10.0, 20.0});
///     ensemble.run([&](Index run, const Results& results) { ... }, {.threads = 2});
class Ensemble {
 public:
  /// Takes the outcome of one run. Called by the thread that ran it, in no certain order, several
  /// at a time. What it throws ends the ensemble and comes out of `run`.
  using Take = std::function<void(Index run, const Results& results)>;

  /// Throws ModelError as Simulator does, and for a span that ends before it begins.
  Ensemble(const System& system, Context base, TimeSpan span, SimulatorOptions options = {});

  /// `values` of the parameter or state `name` (see ContextEntry), `width` of them for each run,
  /// run after run. Throws ModelError for an unknown name, a width that does not fit, another
  /// number of runs than before, and a name whose values are varied already.
  void vary(std::string_view name, std::vector<double> values, Index width = 1);

  Index size() const noexcept { return size_; }
  const Plan& plan() const noexcept { return *plan_; }
  const Context& base() const noexcept { return base_; }
  const TimeSpan& span() const noexcept { return span_; }
  /// The values that a run begins with. Throws ModelError if one makes no sense.
  Context context(Index run) const;

  /// Runs all, and returns how many were run: all, unless `watch` ended it. A run that fails is
  /// handed to `take` with its status and message; the others go on.
  Index run(const Take& take, const EnsembleOptions& how = {}) const;

 private:
  struct Varied {
    std::string name;
    ContextEntry entry;
    std::size_t width;
    std::vector<double> values;
  };
  class Share;
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
