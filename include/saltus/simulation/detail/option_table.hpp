// One row for each option that is a value: its name, its member and its rule. The check of options
// and the Python module read this table. `recorded_signals` and `throw_errors` are not in it:
// Python gives them in another form.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "saltus/simulation/options.hpp"

namespace saltus::detail {

/// The value that a rule expects, in words; empty if the options obey the rule.
using Expected = std::string_view;

template <class T>
struct Option {
  const char* name;
  T SimulatorOptions::*member;
  Expected (*rule)(const SimulatorOptions&) = nullptr;  ///< null: every value makes sense
};

inline Expected unless(bool right, Expected expected) { return right ? Expected{} : expected; }

inline Expected positive(double value) {
  return unless(value > 0.0 && std::isfinite(value), "a positive number");
}

inline Expected positive(const Tolerance& tolerance) {
  if (!tolerance.by_state()) return positive(tolerance.smallest());
  return unless(std::ranges::all_of(tolerance.each(), [](double t) { return positive(t).empty(); }),
                "positive numbers");
}

inline Expected rule_of_rtol(const SimulatorOptions& o) {
  const Expected expected = positive(o.rtol);
  if (!expected.empty()) return expected;
  return unless(o.rtol.smallest() >= 1e-15, "at least 1e-15: a double has no more digits");
}

inline Expected rule_of_first_step(const SimulatorOptions& o) {
  return unless(!o.first_step || (*o.first_step > 0.0 && std::isfinite(*o.first_step)),
                "a time > 0 s, or none");
}

inline const std::tuple option_table{
    Option{"rtol", &SimulatorOptions::rtol, rule_of_rtol},
    Option{"atol", &SimulatorOptions::atol,
           +[](const SimulatorOptions& o) { return positive(o.atol); }},
    Option<Method>{"ode_solver_method", &SimulatorOptions::ode_solver_method},
    Option<LinearSolver>{"linear_solver", &SimulatorOptions::linear_solver},
    Option<bool>{"find_sparsity", &SimulatorOptions::find_sparsity},
    Option{"max_major_steps", &SimulatorOptions::max_major_steps,
           +[](const SimulatorOptions& o) {
             return unless(o.max_major_steps.value_or(1) > 0, "a positive number, or none");
           }},
    Option{"max_major_step_length", &SimulatorOptions::max_major_step_length,
           +[](const SimulatorOptions& o) {
             return unless(o.max_major_step_length > 0.0, "a time > 0 s");
           }},
    Option{"min_minor_step_size", &SimulatorOptions::min_minor_step_size,
           +[](const SimulatorOptions& o) {
             return unless(o.min_minor_step_size >= 0.0, "a time >= 0 s");
           }},
    Option{"max_minor_step_size", &SimulatorOptions::max_minor_step_size,
           +[](const SimulatorOptions& o) {
             return unless(o.max_minor_step_size > o.min_minor_step_size,
                           "more than min_minor_step_size");
           }},
    Option{"first_step", &SimulatorOptions::first_step, rule_of_first_step},
    Option{"zeno_tolerance", &SimulatorOptions::zeno_tolerance,
           +[](const SimulatorOptions& o) {
             return unless(o.zeno_tolerance >= 0.0, "a time >= 0 s");
           }},
    Option{"event_scan_points", &SimulatorOptions::event_scan_points,
           +[](const SimulatorOptions& o) {
             return unless(o.event_scan_points.value_or(0) >= 0, "0 or more");
           }},
    Option{"max_passes", &SimulatorOptions::max_passes,
           +[](const SimulatorOptions& o) { return unless(o.max_passes > 0, "1 or more"); }},
    Option{"event_seed", &SimulatorOptions::event_seed,
           +[](const SimulatorOptions& o) {
             return unless(std::isfinite(o.event_seed), "a finite number");
           }},
    Option<std::vector<std::string>>{"sensitivity", &SimulatorOptions::sensitivity},
    Option<std::vector<double>>{"save_at", &SimulatorOptions::save_at},
    Option<std::optional<bool>>{"save_steps", &SimulatorOptions::save_steps},
    Option<bool>{"event_rows", &SimulatorOptions::event_rows},
    Option<bool>{"dense_output", &SimulatorOptions::dense_output},
    Option<bool>{"record_events", &SimulatorOptions::record_events},
    Option<bool>{"islands", &SimulatorOptions::islands},
    Option{"island_threads", &SimulatorOptions::island_threads,
           +[](const SimulatorOptions& o) {
             return o.island_threads < 0
                        ? Expected("1 or more, or 0 for all cores")
                        : unless(o.island_threads == 1 || o.islands,
                                 "1, because islands is false; set islands to true for threads");
           }},
    Option<std::function<bool()>>{"interrupt", &SimulatorOptions::interrupt},
};

/// Calls `use(option)` for each row.
template <class Use>
void for_each_option(const Use& use) {
  std::apply([&](const auto&... option) { (use(option), ...); }, option_table);
}

template <class T>
std::string shown(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) return text(value);
  return {};
}
template <class T>
std::string shown(const std::optional<T>& value) {
  if constexpr (std::is_arithmetic_v<T>) return value ? text(*value) : "none";
  return {};
}
inline std::string shown(const Tolerance& tolerance) {
  if (!tolerance.by_state()) return text(tolerance.smallest());
  constexpr std::size_t most = 6;
  std::string out = "[";
  for (std::size_t i = 0; i < std::min(most, tolerance.each().size()); ++i)
    out += text(i == 0 ? "" : ", ", tolerance.each()[i]);
  return out + (tolerance.each().size() > most ? ", ...]" : "]");
}

inline void refuse_times(const std::vector<double>& times) {
  const auto refuse = [](double t) {
    throw ModelError(text("option save_at: expected increasing times, found ", t));
  };
  for (const double t : times)
    if (!std::isfinite(t)) refuse(t);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1])) refuse(times[i]);
}

/// Throws ModelError for the first option that makes no sense.
inline void check(const SimulatorOptions& o) {
  for_each_option([&](const auto& option) {
    const Expected expected = option.rule ? option.rule(o) : Expected{};
    if (expected.empty()) return;
    throw ModelError(
        text("option ", option.name, ": expected ", expected, ", found ", shown(o.*option.member)));
  });
  if (!o.event_rows && o.save_at.empty())
    throw ModelError("option event_rows = false: say with save_at when rows are wanted");
  refuse_times(o.save_at);
}

}  // namespace saltus::detail
