// Table: a work-precision report as text for people. CSV and JSON are in written.hpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <ostream>
#include <string>
#include <vector>

#include "saltus/report/work_precision.hpp"

namespace saltus {

namespace detail {

inline std::string short_time(double seconds) {
  if (std::isnan(seconds)) return "-";
  std::array<char, 32> buffer{};
  const bool micro = seconds < 1e-3, milli = seconds < 1.0;
  const double factor = micro ? 1e6 : milli ? 1e3 : 1.0;
  std::snprintf(buffer.data(), buffer.size(), "%.3g %s", seconds * factor,
                micro   ? "us"
                : milli ? "ms"
                        : "s");
  return buffer.data();
}

/// The distance between the quartiles, as a part of the median.
inline std::string spread(const Timing& timing) {
  if (std::isnan(timing.warm)) return "-";
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.0f%%",
                100.0 * (timing.quartile3 - timing.quartile1) / timing.warm);
  return buffer.data();
}

/// A column of a table. It is left out if all its values are unknown.
struct Column {
  std::string title;
  std::vector<std::string> cells;

  bool empty() const {
    return std::ranges::all_of(cells, [](const std::string& cell) { return cell == "-"; });
  }
  int width() const {
    std::size_t most = title.size();
    for (const std::string& cell : cells) most = std::max(most, cell.size());
    return static_cast<int>(most);
  }
};

template <class Show>
Column column(const std::vector<WorkRow>& rows, std::string title, Show&& show) {
  Column made{std::move(title), {}};
  for (const WorkRow& row : rows) made.cells.emplace_back(show(row));
  return made;
}

inline std::vector<Column> columns_of(const std::vector<WorkRow>& rows) {
  const auto error = [&rows](std::string title, double Achieved::*value) {
    return column(rows, std::move(title),
                  [&](const WorkRow& row) { return short_number(row.achieved.*value); });
  };
  const auto count = [&rows](std::string title, auto value) {
    return column(rows, std::move(title),
                  [&](const WorkRow& row) { return text(row.statistics.*value); });
  };
  const auto time = [&rows](std::string title, double Timing::*value) {
    return column(rows, std::move(title),
                  [&](const WorkRow& row) { return short_time(row.timing.*value); });
  };
  return {column(rows, "method", [](const WorkRow& row) { return row.method; }),
          column(rows, "rtol", [](const WorkRow& row) { return short_number(row.rtol); }),
          error("max error", &Achieved::error),
          error("event error", &Achieved::event_error),
          column(rows, "off", [](const WorkRow& row) { return text(row.achieved.event_mismatch); }),
          error("depth", &Achieved::penetration),
          error("drift", &Achieved::invariant_drift),
          error("Zeno time", &Achieved::accumulation_error),
          error("rest", &Achieved::rest_error),
          error("release", &Achieved::release_error),
          time("warm", &Timing::warm),
          column(rows, "spread", [](const WorkRow& row) { return spread(row.timing); }),
          time("cold", &Timing::cold),
          count("steps", &Statistics::steps),
          count("rejected", &Statistics::rejected),
          count("restarts", &Statistics::restarts),
          count("rhs", &Statistics::right_hand_side_calls),
          count("guards", &Statistics::guard_calls),
          count("Jac", &Statistics::jacobian_calls),
          column(rows, "status",
                 [](const WorkRow& row) { return std::string(to_string(row.status)); })};
}

}  // namespace detail

/// Writes rows for people to read. Errors are absolute, times in seconds; "off" counts events too
/// many or too few. Columns without a known value are left out.
inline void write_text(std::ostream& out, const std::vector<WorkRow>& rows) {
  std::vector<detail::Column> columns = detail::columns_of(rows);
  std::erase_if(columns, [](const detail::Column& column) { return column.empty(); });
  const auto line = [&](auto&& cell) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const bool words = k == 0 || k + 1 == columns.size();
      out << (k == 0 ? "" : "  ") << (words ? std::left : std::right)
          << std::setw(k + 1 == columns.size() ? 0 : columns[k].width()) << cell(columns[k]);
    }
    out << std::right << "\n";
  };
  line([](const detail::Column& column) { return column.title; });
  for (std::size_t i = 0; i < rows.size(); ++i)
    line([i](const detail::Column& column) { return column.cells[i]; });
  for (const WorkRow& row : rows) {
    if (!row.message.empty())
      out << row.method << ", rtol " << detail::short_number(row.rtol) << ": " << row.message
          << "\n";
  }
}

/// Writes the rows, with their reference above and the visible orders below.
inline void write_text(std::ostream& out, const WorkReport& report) {
  out << report.scene << ", t = " << report.span.begin << " to " << report.span.end
      << " s\nerrors against (" << to_string(report.reference.kind)
      << "): " << report.reference.provenance << "\n";
  if (!std::isnan(report.reference.bound))
    out << "which may itself be wrong by " << detail::short_number(report.reference.bound) << "\n";
  write_text(out, report.rows);
  for (const auto& [method, order] : report.orders) {
    if (!std::isnan(order))
      out << method << ": error falls with steps^-" << std::round(10.0 * order) / 10.0 << "\n";
  }
  const Environment& e = report.environment;
  out << e.cpu << ", " << e.cores << " cores; " << e.compiler << " (" << e.build << "), SUNDIALS "
      << e.sundials << ", Saltus " << e.saltus << "\n";
}

}  // namespace saltus
