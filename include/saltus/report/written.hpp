// Written: a work-precision report as CSV and as JSON, for programs.
#pragma once

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "saltus/report/work_precision.hpp"

namespace saltus {

namespace detail {

/// The contents of one column. Names are the keys of JSON and the headers of CSV.
struct Cell {
  std::string name;
  std::variant<double, std::int64_t, std::string> value;
};

inline std::vector<Cell> cells_of(const WorkRow& row, const std::vector<std::string>& invariants) {
  const Statistics& s = row.statistics;
  const Achieved& a = row.achieved;
  const Timing& t = row.timing;
  std::vector<Cell> cells{{"method", row.method},
                          {"rtol", row.rtol},
                          {"atol", row.atol},
                          {"against", row.against},
                          {"error", a.error},
                          {"scaled_error", a.scaled},
                          {"event_error", a.event_error},
                          {"event_mismatch", a.event_mismatch},
                          {"penetration", a.penetration},
                          {"invariant_drift", a.invariant_drift},
                          {"accumulation_error", a.accumulation_error},
                          {"rest_error", a.rest_error},
                          {"release_error", a.release_error},
                          {"seconds", t.warm},
                          {"seconds_quartile1", t.quartile1},
                          {"seconds_quartile3", t.quartile3},
                          {"repeats", std::int64_t{t.repeats}},
                          {"cold_seconds", t.cold},
                          {"used_method", s.method},
                          {"steps", s.steps},
                          {"rejected", s.rejected},
                          {"restarts", s.restarts},
                          {"right_hand_side_calls", s.right_hand_side_calls},
                          {"guard_calls", s.guard_calls},
                          {"jacobian_calls", s.jacobian_calls},
                          {"linear_setups", s.linear_setups},
                          {"events", s.events},
                          {"status", std::string(to_string(row.status))},
                          {"message", row.message}};
  for (std::size_t k = 0; k < invariants.size(); ++k)
    cells.push_back(
        {"drift of " + invariants[k], k < a.drifts.size() ? a.drifts[k] : Achieved::unknown});
  return cells;
}

/// The value in CSV or JSON: `escape` comes before a quote within quotes, `unknown` replaces an
/// unknown number. Numbers are the shortest that give the same bits when read.
inline std::string written(const Cell& cell, char escape, std::string_view unknown) {
  if (const auto* number = std::get_if<double>(&cell.value)) {
    return std::isfinite(*number) ? text(*number) : std::string(unknown);
  }
  if (const auto* count = std::get_if<std::int64_t>(&cell.value)) return text(*count);
  std::string out = "\"";
  for (const char c : std::get<std::string>(cell.value)) {
    if (c == '"' || c == escape) out += escape;
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

inline std::string object_of(const std::vector<Cell>& cells) {
  std::string out = "{";
  for (std::size_t k = 0; k < cells.size(); ++k) {
    out += k == 0 ? "" : ", ";
    out += written({"", cells[k].name}, '\\', "null") + ": " + written(cells[k], '\\', "null");
  }
  return out + "}";
}

/// The columns for machine and versions.
inline std::vector<Cell> cells_of(const Environment& e) {
  return {{"cpu", e.cpu},     {"cores", std::int64_t{e.cores}}, {"compiler", e.compiler},
          {"build", e.build}, {"sundials", e.sundials},         {"saltus", e.saltus}};
}

/// The columns for the reference.
inline std::vector<Cell> cells_of(const Reference& reference) {
  return {{"kind", std::string(to_string(reference.kind))},
          {"provenance", reference.provenance},
          {"bound", reference.bound},
          {"event_bound", reference.event_bound}};
}

}  // namespace detail

/// Writes lines of "# name: value" about the scene, the reference and the machine, then a line of
/// names, then a line for each row. Unknown values are empty.
inline void write_csv(std::ostream& out, const WorkReport& report) {
  out << "# scene: " << report.scene << "\n";
  for (const auto& cell : detail::cells_of(report.reference))
    out << "# reference " << cell.name << ": " << detail::written(cell, '"', "") << "\n";
  for (const auto& cell : detail::cells_of(report.environment))
    out << "# " << cell.name << ": " << detail::written(cell, '"', "") << "\n";
  const auto line = [&out](const std::vector<detail::Cell>& cells, auto&& show) {
    for (std::size_t k = 0; k < cells.size(); ++k) out << (k == 0 ? "" : ",") << show(cells[k]);
    out << "\n";
  };
  line(detail::cells_of(WorkRow(), report.invariants),
       [](const detail::Cell& cell) { return cell.name; });
  for (const WorkRow& row : report.rows)
    line(detail::cells_of(row, report.invariants),
         [](const detail::Cell& cell) { return detail::written(cell, '"', ""); });
}

/// Writes one object: the scene, the reference, the machine, "orders" by method, and "rows".
/// Unknown values are null.
inline void write_json(std::ostream& out, const WorkReport& report) {
  using detail::cells_of, detail::object_of;
  std::vector<detail::Cell> orders;
  for (const auto& [method, order] : report.orders) orders.push_back({method, order});
  const std::string head =
      object_of({{"format", std::string("saltus work-precision 1")},
                 {"scene", report.scene},
                 {"title", report.title},
                 {"begin", report.span.begin},
                 {"end", report.span.end},
                 {"growth", report.growth},
                 {"cold", std::string(report.cold_makes_system ? "system, plan and first run"
                                                               : "plan and first run")}});
  out << head.substr(0, head.size() - 1)
      << ",\n \"reference\": " << object_of(cells_of(report.reference))
      << ",\n \"environment\": " << object_of(cells_of(report.environment))
      << ",\n \"orders\": " << object_of(orders) << ",\n \"rows\": [";
  for (std::size_t i = 0; i < report.rows.size(); ++i)
    out << (i == 0 ? "\n  " : ",\n  ") << object_of(cells_of(report.rows[i], report.invariants));
  out << "\n]}\n";
}

}  // namespace saltus
