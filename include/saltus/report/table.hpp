// Table: rows of a work-precision report as text for people, as CSV and as JSON for programs.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iomanip>
#include <ostream>
#include <string>
#include <string_view>
#include <variant>
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
  std::snprintf(buffer.data(), buffer.size(), "%.3g %s",
                seconds * (micro   ? 1e6
                           : milli ? 1e3
                                   : 1.0),
                micro   ? "us"
                : milli ? "ms"
                        : "s");
  return buffer.data();
}

/// What stands in one column, for programs.
struct Cell {
  std::string_view name;
  std::variant<double, std::int64_t, std::string> value;
};

inline std::vector<Cell> cells_of(const WorkRow& row) {
  const Statistics& s = row.statistics;
  return {{"method", row.method},
          {"rtol", row.rtol},
          {"atol", row.atol},
          {"error", row.achieved.error},
          {"scaled_error", row.achieved.scaled},
          {"event_error", row.achieved.event_error},
          {"event_mismatch", row.achieved.event_mismatch},
          {"accumulation_error", row.achieved.accumulation_error},
          {"release_error", row.achieved.release_error},
          {"seconds", row.seconds},
          {"steps", s.steps},
          {"rejected", s.rejected},
          {"restarts", s.restarts},
          {"right_hand_side_calls", s.right_hand_side_calls},
          {"guard_calls", s.guard_calls},
          {"jacobian_calls", s.jacobian_calls},
          {"status", std::string(to_string(row.status))},
          {"message", row.message}};
}

/// The value as CSV or JSON has it: `escape` stands before a quote within quotes, `unknown` for a
/// number nobody knows.
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

}  // namespace detail

/// For reading. Errors are absolute, times in seconds; "off" counts events too many or too few.
inline void write_text(std::ostream& out, const std::vector<WorkRow>& rows) {
  const auto line = [&out](const auto&... cells) {
    const std::array<std::string, sizeof...(cells)> all{std::string(cells)...};
    constexpr std::array<int, 10> widths{8, 9, 11, 13, 5, 10, 9, 9, 9, 2};
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      out << (i == 0 ? std::left : std::right) << std::setw(widths[i]) << all[i];
    out << "  " << all.back() << "\n";
  };
  line("method", "rtol", "max error", "event error", "off", "run time", "steps", "rhs", "guards",
       "status");
  for (const WorkRow& row : rows) {
    const Statistics& s = row.statistics;
    line(row.method, detail::short_number(row.rtol), detail::short_number(row.achieved.error),
         detail::short_number(row.achieved.event_error), text(row.achieved.event_mismatch),
         detail::short_time(row.seconds), text(s.steps), text(s.right_hand_side_calls),
         text(s.guard_calls), to_string(row.status));
  }
  for (const WorkRow& row : rows) {
    if (!row.message.empty())
      out << row.method << ", rtol " << detail::short_number(row.rtol) << ": " << row.message
          << "\n";
  }
}

/// One line of names, then one line for each row; unknown values are empty.
inline void write_csv(std::ostream& out, const std::vector<WorkRow>& rows) {
  const auto names = detail::cells_of(WorkRow());
  for (std::size_t k = 0; k < names.size(); ++k) out << (k == 0 ? "" : ",") << names[k].name;
  out << "\n";
  for (const WorkRow& row : rows) {
    const auto cells = detail::cells_of(row);
    for (std::size_t k = 0; k < cells.size(); ++k)
      out << (k == 0 ? "" : ",") << detail::written(cells[k], '"', "");
    out << "\n";
  }
}

/// An array of objects; unknown values are null.
inline void write_json(std::ostream& out, const std::vector<WorkRow>& rows) {
  out << "[";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out << (i == 0 ? "\n  {" : ",\n  {");
    const auto cells = detail::cells_of(rows[i]);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      out << (k == 0 ? "\"" : ", \"") << cells[k].name
          << "\": " << detail::written(cells[k], '\\', "null");
    }
    out << "}";
  }
  out << "\n]\n";
}

}  // namespace saltus
