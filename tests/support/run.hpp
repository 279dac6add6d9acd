// The common parts of all tests of runs: the methods, thrown errors, rows and events of a result.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "saltus/simulation/simulate.hpp"
#include "support/catch.hpp"

namespace saltus {

// Prints a value for INFO and REQUIRE.
inline std::ostream& operator<<(std::ostream& out, Method method) {
  return out << to_string(method);
}
inline std::ostream& operator<<(std::ostream& out, LinearSolver solver) {
  return out << to_string(solver);
}

}  // namespace saltus

namespace support {

inline constexpr std::array methods{saltus::Method::dopri5, saltus::Method::dop853,
                                    saltus::Method::adams,  saltus::Method::bdf,
                                    saltus::Method::radau,  saltus::Method::automatic};

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The message of the `Expected` that `act` throws.
template <class Expected, class Act>
std::string message(Act act) {
  try {
    act();
  } catch (const Expected& error) {
    return error.what();
  } catch (const std::exception& other) {
    return std::string("another exception: ") + other.what();
  }
  return "no exception";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The number of events of a kind, and of one name if it is given.
inline int count(const saltus::EventLog& log, saltus::EventKind kind, std::string_view name = {}) {
  int found = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    found += log[i].kind == kind && (name.empty() || log[i].name == name);
  }
  return found;
}

/// "zero_crossing ball.bounce" for each event, in order: the shape of a run.
inline std::vector<std::string> events(const saltus::EventLog& log) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const saltus::Event event = log[i];
    all.push_back(saltus::text(saltus::to_string(event.kind), " ", event.block, ".", event.name));
  }
  return all;
}

/// The rows at exactly time t.
inline std::vector<std::size_t> rows_at(const saltus::Results& results, double t) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    if (results.time[i] == t) rows.push_back(i);
  }
  return rows;
}

/// Entry `column` of a recorded signal, row by row.
inline std::vector<double> column(const saltus::Results& results, std::string_view name,
                                  saltus::Index column = 0) {
  const auto matrix = results.output(name);
  std::vector<double> values;
  for (saltus::Index row = 0; row < matrix.rows(); ++row) values.push_back(matrix(row, column));
  return values;
}

/// Equal to the last bit: times, jumps, kinds, sources, states.
inline bool same_bits(const saltus::EventLog& a, const saltus::EventLog& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const saltus::Event p = a[i], q = b[i];
    if (p.time != q.time || p.jump != q.jump || p.kind != q.kind || p.direction != q.direction)
      return false;
    if (p.block != q.block || p.name != q.name || !same(p.predicted, q.predicted)) return false;
    if (!std::ranges::equal(p.before, q.before) || !std::ranges::equal(p.after, q.after))
      return false;
  }
  return true;
}
inline bool same_bits(const saltus::Context& a, const saltus::Context& b) {
  return a.time() == b.time() && a.continuous_state() == b.continuous_state() &&
         a.modes() == b.modes() && a.discrete_state() == b.discrete_state() &&
         a.parameters() == b.parameters();
}

}  // namespace support
