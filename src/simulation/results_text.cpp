// std::cout << results: the text that Python's print(results) shows.
#include <algorithm>
#include <cstdio>
#include <ostream>

#include "saltus/base/error.hpp"
#include "saltus/simulation/results.hpp"

namespace saltus {
namespace {

constexpr std::size_t listed = 5;  // events by name, and blocks at rest, that a line has room for

std::string number(const char* format, double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, format, value);
  return digits;
}

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
  std::string all;
  for (const std::string& part : parts) (all.empty() ? all : all += between) += part;
  return all;
}

bool stepped_apart(const Results& results) {
  return std::ranges::any_of(results.signals, [](const auto& s) { return s.island >= 0; });
}

std::string head(const Results& results) {
  std::size_t rows = results.time.size();
  std::string span = "t = " + number("%g", results.context.time()) + " s";
  if (stepped_apart(results)) {
    rows = 0;
    for (const IslandResults& island : results.islands) rows += island.time.size();
    span = "to " + span;
  } else if (rows > 0) {
    span = "t = " + number("%g", results.time.front()) + " to " +
           number("%g", results.time.back()) + " s";
  }
  return text(to_string(results.status), ", ", rows, " rows, ", span);
}

/// "3" or "2, 3".
std::string dimensions(const Shape& shape) {
  return shape.is_matrix() ? text(shape.rows(), ", ", shape.columns) : text(shape.size);
}

std::string outputs(const Results& results) {
  std::vector<std::string> parts;
  for (const RecordedSignal& signal : results.signals) {
    const Index width = std::max<Index>(signal.shape.size, 1);
    const auto rows =
        signal.shape.size > 0
            ? static_cast<std::size_t>(static_cast<Index>(signal.values.size()) / width)
            : results.time.size();
    parts.push_back(signal.shape.vector
                        ? text(signal.name, " (", rows, ", ", dimensions(signal.shape), ")")
                        : text(signal.name, " (", rows, ",)"));
  }
  return parts.empty() ? "nothing recorded" : joined(parts, ", ");
}

std::string events(const Results& results) {
  const auto& by_name = results.statistics.events_by_name;
  std::vector<std::string> parts;
  for (const auto& [name, count] : by_name)
    if (parts.size() < listed) parts.push_back(text(name, " ", count));
  if (by_name.size() > listed) parts.push_back(text(by_name.size() - listed, " other kinds"));
  return text(results.events.size(), " events", parts.empty() ? "" : ": ", joined(parts, ", "));
}

std::string at_rest(const Results& results) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < results.events.size() && parts.size() < listed; ++i) {
    const Event event = results.events[i];
    if (event.kind == EventKind::zeno_enter)
      parts.push_back(text(event.block, " from ", number("%.6g", event.time), " s"));
  }
  return joined(parts, ", ");
}

std::string methods_used(const Statistics& s) {
  if (s.stretches.size() < 2) return s.method;
  std::vector<std::string> used;
  for (const Stretch& stretch : s.stretches)
    if (std::ranges::find(used, stretch.method) == used.end()) used.push_back(stretch.method);
  return text(joined(used, " and "), " (", s.stretches.size(), " stretches)");
}

std::string duration(double seconds) {
  if (seconds >= 1.0) return number("%.3g s", seconds);
  if (seconds * 1e3 >= 1.0) return number("%.3g ms", seconds * 1e3);
  return number("%.3g µs", seconds * 1e6);
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Results& results) {
  const Statistics& s = results.statistics;
  const Trajectory& dense = results.trajectory;
  const std::pair<std::string_view, std::string> lines[] = {
      {"why", results.message},
      {"outputs", outputs(results)},
      {"islands",
       results.islands.empty() ? "" : text(results.islands.size(), " that stepped apart")},
      {"events", events(results)},
      {"at rest", at_rest(results)},
      {"steps", text(s.steps, " steps of ", methods_used(s), ", ", s.rejected, " rejected, ",
                     s.restarts, " restarts")},
      {"calls", text(s.right_hand_side_calls, " right-hand side, ", s.guard_calls, " guards")},
      {"took", duration(s.wall_time)},
      {"dense output", dense.empty() ? ""
                                     : "at any time from " + number("%g", dense.begin()) + " to " +
                                           number("%g", dense.end()) + " s"}};
  out << "<Results: " << head(results);
  for (const auto& [name, said] : lines)
    if (!said.empty()) out << "\n  " << name << std::string(14 - name.size(), ' ') << said;
  return out << '>';
}

}  // namespace saltus
