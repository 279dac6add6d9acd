// Ensemble: the distribution of its runs to threads, and the course of one run.
#include "saltus/simulation/ensemble.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/plan/compile.hpp"
#include "saltus/plan/detail/memory.hpp"
#include "saltus/solver/detail/one_thread.hpp"

namespace saltus {

using Clock = std::chrono::steady_clock;
constexpr auto look_every = std::chrono::milliseconds(50);

/// The data that the threads of one call of `run` share.
struct Ensemble::Progress {
  std::atomic<Index> next{0}, done{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::condition_variable ended;
  int working = 0;
  std::exception_ptr thrown;

  /// Keeps the first exception and stops all threads. Called in a handler.
  void fail() {
    const std::lock_guard lock(mutex);
    if (!thrown) thrown = std::current_exception();
    stop = true;
  }
};

/// The work of one thread.
class Ensemble::Worker {
 public:
  Worker(const Ensemble& ensemble, const Take& take, Progress& progress,
         std::function<bool(Index)> watch)
      : ensemble_(&ensemble), take_(&take), progress_(&progress), watch_(std::move(watch)) {}

  void run() {
    try {
      run_all();
    } catch (...) {
      detail::pass_end_of_thread();
      progress_->fail();
    }
  }

 private:
  /// A thread takes few runs at a time, so that no thread ends with many slow runs.
  static constexpr Index at_a_time = 8;

  void run_all() {
    Simulator simulator(ensemble_->plan_, options());
    Context values = ensemble_->base_;
    for (Index first; (first = progress_->next.fetch_add(at_a_time)) < ensemble_->size_;) {
      const Index last = std::min(first + at_a_time, ensemble_->size_);
      for (Index run = first; run < last && !stopped(); ++run) {
        run_one(simulator, values, run);
        ++progress_->done;
      }
    }
  }

  void run_one(Simulator& simulator, Context& values, Index run) {
    try {
      ensemble_->write(values, run);
      simulator.initialize(values);
    } catch (...) {
      detail::pass_end_of_thread();
      return (*take_)(run, refused(values));
    }
    simulator.advance_to(ensemble_->span_.end);
    (*take_)(run, simulator.results());
  }

  /// The results of a run that could not begin. Called in a handler.
  static Results refused(const Context& values) {
    Results results;
    results.context = values;
    results.status = Status::failed;
    results.cause = std::current_exception();
    try {
      throw;
    } catch (const std::exception& error) {
      results.message = error.what();
    } catch (...) {
      results.message = "a function of the model threw";
    }
    return results;
  }

  SimulatorOptions options() {
    SimulatorOptions options = ensemble_->options_;
    options.interrupt = [this, asked = options.interrupt] {
      return stopped() || (asked && asked());
    };
    return options;
  }

  /// Whether the call was ended. The calling thread also asks the caller from time to time.
  bool stopped() {
    if (progress_->stop) return true;
    if (!watch_) return false;
    const auto now = Clock::now();
    if (now - looked_ < look_every) return false;
    looked_ = now;
    if (watch_(progress_->done)) progress_->stop = true;
    return progress_->stop;
  }

  const Ensemble* ensemble_;
  const Take* take_;
  Progress* progress_;
  std::function<bool(Index)> watch_;
  Clock::time_point looked_ = Clock::now();
};

Ensemble::Ensemble(const System& system, Context base, TimeSpan span, SimulatorOptions options)
    : plan_(compile(system, options.recorded_signals, options.refinement.get())),
      base_(base.time() == span.begin ? std::move(base) : base.with_time(span.begin)),
      span_(span),
      options_(std::move(options)) {
  if (!(span.end >= span.begin)) {
    throw ModelError(text("ensemble: expected a span with begin <= end, found ", span.begin,
                          " s to ", span.end, " s"));
  }
  options_.recorded_signals.clear();  // the plan has them
  options_.refinement.reset();
  options_.throw_errors = false;
  require_context_of(*plan_, base_);
  const Simulator checked(plan_, options_);
}

void Ensemble::require_new(std::string_view name, const ContextEntry& entry) const {
  for (const Varied& other : varied_) {
    const bool apart = other.entry.kind != entry.kind ||
                       other.entry.first + other.entry.size <= entry.first ||
                       entry.first + entry.size <= other.entry.first;
    if (!apart)
      throw ModelError(text("'", name, "' and '", other.name, "' are the same values; vary one"));
  }
}

void Ensemble::vary(std::string_view name, std::vector<double> values, Index width) {
  const ContextEntry entry = find_entry(base_.layout(), name);
  detail::require_settable(entry.role, name);
  require_new(name, entry);
  require_width(entry, width, name);
  const Index runs = static_cast<Index>(values.size()) / width;
  if (runs * width != static_cast<Index>(values.size()) || (!varied_.empty() && runs != size_)) {
    throw ModelError(text("'", name, "': expected ", width, " values for each of ", size_,
                          " runs, found ", values.size()));
  }
  varied_.push_back({std::string(name), entry, static_cast<std::size_t>(width), std::move(values)});
  size_ = runs;
}

void Ensemble::write(Context& context, Index run) const {
  for (const Varied& v : varied_) {
    const auto values =
        std::span(v.values).subspan(static_cast<std::size_t>(run) * v.width, v.width);
    write_entry(context, v.entry, values, v.name);
  }
}

Context Ensemble::context(Index run) const {
  Context values = base_;
  write(values, run);
  return values;
}

Index Ensemble::run(const Take& take, const EnsembleOptions& how) const {
  if (how.threads < 0)
    throw ModelError(text("threads: expected 1 or more, or 0 for all cores; found ", how.threads));
  const auto cores = static_cast<Index>(std::max(1U, std::thread::hardware_concurrency()));
  const Index threads = std::min(how.threads == 0 ? cores : Index{how.threads}, size_);
  Progress progress;
  if (threads <= 1) {
    std::optional<OneThread> alone;
    if (how.threads == 1) alone.emplace();
    Worker(*this, take, progress, how.watch).run();
  } else {
    const auto runs = [&] {
      const OneThread alone;
      Worker(*this, take, progress, {}).run();
    };
    const auto work = [&] {
      how.around ? how.around(runs) : runs();
      const std::lock_guard lock(progress.mutex);
      --progress.working;
      progress.ended.notify_one();
    };
    progress.working = static_cast<int>(threads);
    std::vector<std::jthread> all;
    for (Index i = 0; i < threads; ++i) all.emplace_back(work);
    std::unique_lock lock(progress.mutex);
    while (!progress.ended.wait_for(lock, look_every, [&] { return progress.working == 0; })) {
      lock.unlock();
      try {
        if (how.watch && how.watch(progress.done)) progress.stop = true;
      } catch (...) {
        detail::pass_end_of_thread();
        progress.fail();
      }
      lock.lock();
    }
  }
  if (progress.thrown) std::rethrow_exception(progress.thrown);
  return progress.done;
}

}  // namespace saltus
