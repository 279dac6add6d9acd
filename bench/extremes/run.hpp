// Runs a case by one method and judges the result.
#pragma once

#include <chrono>
#include <ctime>

#include "extremes/case.hpp"

namespace extremes {

enum class Verdict { right, clear_error, wrong };

inline std::string_view to_string(Verdict verdict) {
  constexpr std::string_view names[] = {"right", "clear error", "WRONG"};
  return names[static_cast<std::size_t>(verdict)];
}

struct Row {
  Verdict verdict = Verdict::right;
  std::string happened = {};  ///< the status, or the message
  Finding finding = {};
  std::int64_t steps = 0;
  double seconds = 0.0;
};

/// Longest run of a trial [s of processor time, so that other work on the machine does not count]; a
/// longer run counts as wrong. The sanitizers take some six times as long.
#ifdef __SANITIZE_ADDRESS__
inline constexpr double limit = 60.0;
#else
inline constexpr double limit = 10.0;
#endif

namespace detail {

/// Whether an error comes at the expected time, with the expected message.
inline Verdict verdict_of_error(const Case& c, const std::string& message, double time) {
  if (c.expected == Expected::answer)
    return message.empty() ? Verdict::wrong : Verdict::clear_error;
  const bool says = !message.empty() && message.find(c.error_says) != std::string::npos;
  const bool in_time = !(std::abs(time - c.error_time) > 1e-3 * std::abs(c.error_time));
  return says && in_time ? Verdict::clear_error : Verdict::wrong;
}

inline void judge(const Case& c, const Trial& trial, const Results& results, Row& row) {
  row.steps = results.statistics.steps;
  row.happened = saltus::to_string(results.status);
  if (saltus::ended_well(results.status)) {
    if (trial.law) row.finding = trial.law(results, trial.options);
    const bool good = row.finding.error <= row.finding.allowed && row.finding.events_right;
    row.verdict = good && c.expected != Expected::error ? Verdict::right : Verdict::wrong;
  } else {
    row.happened = results.message;
    const bool stopped = results.status == saltus::Status::interrupted;
    row.verdict =
        stopped ? Verdict::wrong : verdict_of_error(c, results.message, results.context.time());
  }
}

}  // namespace detail

inline Row run(const Case& c, Trial trial, saltus::Method method) {
  Row row;
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  trial.options.ode_solver_method = method;
  trial.options.throw_errors = false;
  trial.options.interrupt = [start = std::clock()] {
    return static_cast<double>(std::clock() - start) > limit * CLOCKS_PER_SEC;
  };
  try {
    const Results results = saltus::simulate(*trial.system, trial.start, trial.span, trial.options);
    row.seconds = passed();
    detail::judge(c, trial, results, row);
  } catch (const saltus::ModelError& error) {  // refused before it began
    row.seconds = passed();
    row.happened = error.what();
    row.verdict = detail::verdict_of_error(c, row.happened, trial.span.begin);
    if (std::isfinite(c.error_time)) row.verdict = Verdict::wrong;
  }
  return row;
}

/// The worst of all trials, with the steps and the time of all.
inline Row run(const Case& c, saltus::Method method) {
  Row worst;
  std::int64_t steps = 0;
  double seconds = 0.0;
  bool first = true;
  for (Trial& trial : c.trials()) {
    Row row = run(c, std::move(trial), method);
    steps += row.steps, seconds += row.seconds;
    const auto rank = [](const Row& r) { return std::pair(r.verdict, r.finding.error); };
    if (first || rank(row) > rank(worst)) worst = std::move(row);
    first = false;
  }
  worst.steps = steps, worst.seconds = seconds;
  return worst;
}

}  // namespace extremes
