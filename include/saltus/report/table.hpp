// Table: rows of a work-precision report as text for people, as CSV and as JSON for programs.
#pragma once

#include <array>
#include <cstdio>
#include <iomanip>
#include <ostream>
#include <string>
#include <vector>

#include "saltus/report/work_precision.hpp"

namespace saltus {

namespace detail {

/// Two digits: what an error, or a time, is good for. "-" where nothing is known.
inline std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.1e", value);
  return buffer.data();
}

inline std::string short_time(double seconds) {
  if (std::isnan(seconds)) return "-";
  std::array<char, 32> buffer{};
  const bool micro = seconds < 1e-3, milli = seconds < 1.0;
  std::snprintf(buffer.data(), buffer.size(), "%.3g %s", seconds * (micro ? 1e6 : milli ? 1e3 : 1.0),
                micro ? "us" : milli ? "ms" : "s");
  return buffer.data();
}

inline std::string quoted(std::string_view words) {
  std::string out = "\"";
  for (const char c : words) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) out += c;
  }
  return out + "\"";
}

/// A cell: the name of its column, and its value as a JSON literal.
using Cells = std::vector<std::pair<std::string, std::string>>;

inline std::string literal(double value) { return std::isfinite(value) ? text(value) : "null"; }

inline Cells cells_of(const WorkRow& row) {
  return {{"method", quoted(row.method)},
          {"rtol", literal(row.rtol)},
          {"atol", literal(row.atol)},
          {"error", literal(row.achieved.error)},
          {"scaled_error", literal(row.achieved.scaled)},
          {"event_error", literal(row.achieved.event_error)},
          {"event_mismatch", text(row.achieved.event_mismatch)},
          {"accumulation_error", literal(row.achieved.accumulation_error)},
          {"release_error", literal(row.achieved.release_error)},
          {"seconds", literal(row.seconds)},
          {"steps", text(row.statistics.steps)},
          {"rejected", text(row.statistics.rejected)},
          {"restarts", text(row.statistics.restarts)},
          {"right_hand_side_calls", text(row.statistics.right_hand_side_calls)},
          {"guard_calls", text(row.statistics.guard_calls)},
          {"jacobian_calls", text(row.statistics.jacobian_calls)},
          {"status", quoted(to_string(row.status))},
          {"message", quoted(row.message)}};
}

}  // namespace detail

/// For reading. Errors are absolute, times in seconds; "off" counts events too many or too few.
inline void write_text(std::ostream& out, const std::vector<WorkRow>& rows) {
  const auto line = [&out](const auto&... cells) {
    const std::array<std::string, sizeof...(cells)> all{std::string(cells)...};
    constexpr std::array<int, 10> widths{8, 9, 11, 13, 5, 10, 9, 9, 9, 2};
    for (std::size_t i = 0; i + 1 < all.size(); ++i) out << (i == 0 ? std::left : std::right) << std::setw(widths[i]) << all[i];
    out << "  " << all.back() << "\n";
  };
  line("method", "rtol", "max error", "event error", "off", "run time", "steps", "rhs", "guards", "status");
  for (const WorkRow& row : rows) {
    const Statistics& s = row.statistics;
    line(row.method, detail::short_number(row.rtol), detail::short_number(row.achieved.error),
         detail::short_number(row.achieved.event_error), text(row.achieved.event_mismatch), detail::short_time(row.seconds),
         text(s.steps), text(s.right_hand_side_calls), text(s.guard_calls), to_string(row.status));
  }
  for (const WorkRow& row : rows) {
    if (!row.message.empty()) out << row.method << ", rtol " << detail::short_number(row.rtol) << ": " << row.message << "\n";
  }
}

/// One line of names, then one line for each row; unknown values are empty.
inline void write_csv(std::ostream& out, const std::vector<WorkRow>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const detail::Cells cells = detail::cells_of(rows[i]);
    if (i == 0) {
      for (std::size_t k = 0; k < cells.size(); ++k) out << (k == 0 ? "" : ",") << cells[k].first;
      out << "\n";
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      out << (k == 0 ? "" : ",") << (cells[k].second == "null" ? "" : cells[k].second);
    }
    out << "\n";
  }
}

/// An array of objects; unknown values are null.
inline void write_json(std::ostream& out, const std::vector<WorkRow>& rows) {
  out << "[";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out << (i == 0 ? "\n  {" : ",\n  {");
    const detail::Cells cells = detail::cells_of(rows[i]);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      out << (k == 0 ? "" : ", ") << detail::quoted(cells[k].first) << ": " << cells[k].second;
    }
    out << "}";
  }
  out << "\n]\n";
}

}  // namespace saltus
