// The page: docs/stability.md.
#pragma once

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "extremes/run.hpp"

namespace extremes {

namespace detail {

/// Classes of time, so that the page changes only with the results.
inline std::string_view time_class(double seconds) {
  constexpr std::pair<double, std::string_view> classes[] = {
      {1e-3, "< 1 ms"}, {1e-2, "< 10 ms"}, {0.1, "< 0.1 s"}, {1.0, "< 1 s"}, {10.0, "< 10 s"}};
  for (const auto& [most, name] : classes)
    if (seconds < most) return name;
  return "> 10 s";
}

inline std::string error_text(const Row& row) {
  if (row.verdict == Verdict::clear_error || !row.finding.events_right) return "";
  const double error = row.finding.error;
  if (error == 0.0 || !std::isfinite(error)) return error == 0.0 ? "0" : "infinite";
  char digits[32];
  std::snprintf(digits, sizeof digits, error < 0.01 ? "< 0.01" : "%.2g", error);
  return digits;
}

/// The first 100 characters of a message's first line, without characters that would end a cell.
inline std::string cell(std::string message) {
  message = message.substr(0, message.find('\n'));
  std::erase(message, '|');
  constexpr std::size_t most = 100;
  if (message.size() > most) message = message.substr(0, message.rfind(' ', most)) + " ...";
  return message;
}

}  // namespace detail

/// The result of one method on one case.
struct Line {
  std::string scene, method;
  Row row;
};

/// The results of a group.
struct Table {
  std::string title, text;
  std::vector<Line> lines;

  auto count(Verdict verdict) const {
    return std::ranges::count(lines, verdict, [](const Line& line) { return line.row.verdict; });
  }
};

/// Names a scene once, before its first method.
inline void write(std::ostream& out, const Table& table) {
  out << "\n## " << table.title << "\n\n";
  if (!table.text.empty()) out << table.text << "\n\n";
  out << "| scene | method | what happened | error | events | steps | time | verdict |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::string before;
  for (const auto& [scene, method, row] : table.lines) {
    out << "| " << (scene == before ? "" : scene) << " | " << method << " | "
        << detail::cell(row.happened) << " | " << detail::error_text(row) << " | "
        << row.finding.events << " | " << row.steps << " | " << detail::time_class(row.seconds)
        << " | " << (row.verdict == Verdict::wrong ? "**WRONG**" : to_string(row.verdict))
        << " |\n";
    before = scene;
  }
}

inline void write_introduction(std::ostream& out) {
  out << R"(# Extreme scenes

States of 1e-300 and 1e300, horizons of 1e-12 s and 1e12 s, a hundred thousand states, a million events, solutions that end: what
comes out, by every method that makes sense. Every row is right or a clear error; a silent wrong answer would be the one thing
that must not be, and stands here as **WRONG** as long as there is one.

**How an error is counted.** Against a closed form, or for a scaled scene against the unscaled one. The unit is the tolerance,
(rtol |x| + atol) times the growth of the problem (what local errors of one tolerance make at the end: the radians of an oscillator,
the time constants of a decay), and one rounding of |x| for each step. Over the states it is the root mean square, the norm in which steps are
controlled; times of events count in units of what a unit of the state makes of them, beyond the 100 eps t with which they are located
([semantics](semantics.md), 2.9). Right is an error up to 10, for `bdf` up to 100, with the exact number of events.
A clear error is a `ModelError` or a `SimulationError`; where a solution ends it has to come at that time. A run that takes longer
than 10 s is stopped, and counts as wrong.

**What is not here:** a pulse of 1e-9 s that no guard, no source and no `max_minor_step_size` announces. No method that looks at f
at the points of its steps can see it.

**Bits.** Multiplied by a power of two a scene has to give the same run, multiplied, to the last bit. That is more than a tolerance
asks for: such a row is WRONG with an error far below 10 too.

Of a sweep of several runs the worst is shown, with the steps and the time of all. `./dev stability` makes this page again.
)";
}

/// The number of rows with each verdict in a group.
inline void write_sum(std::ostream& out, const std::vector<Table>& tables) {
  constexpr std::array verdicts{Verdict::right, Verdict::clear_error, Verdict::wrong};
  out << "\n| group | right | clear error | WRONG |\n| --- | --- | --- | --- |\n";
  std::array<std::ptrdiff_t, 3> sum{};
  const auto row = [&out](const std::string& name, const auto& counts) {
    out << "| " << name << " | " << counts[0] << " | " << counts[1] << " | " << counts[2] << " |\n";
  };
  for (const Table& table : tables) {
    std::array<std::ptrdiff_t, 3> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) sum[i] += counts[i] = table.count(verdicts[i]);
    row(table.title, counts);
  }
  row("sum", sum);
}

}  // namespace extremes
