// Edge series: which firings of edge_detection are those of a value that varies all the time.
#include "saltus/solver/detail/edge_series.hpp"

#include <cstdint>

#include "support/catch.hpp"

using namespace saltus;

namespace edge_series_test {

/// How many firings at t0, t0 + gap, ... a series takes; 5000: no end.
std::int64_t firings_to_end(double t0, double gap, double change, double value, double step) {
  EdgeSeries series;
  for (std::int64_t k = 0; k < 5000; ++k) {
    if (series.is_endless({t0 + gap * static_cast<double>(k), step, change, value})) return k;
  }
  return 5000;
}

struct Row {
  const char* what;
  double gap, change, value, step;
  bool endless;
};

}  // namespace edge_series_test

TEST_CASE("A thousand edges in a row that are close to each other are without end") {
  using namespace edge_series_test;
  const double eps = thresholds::eps;
  const Row row = GENERATE_COPY(values<Row>(
      {{"a difference that varies by its rounding, slowly", 1e-3, eps, 1.0, 1.0, true},
       {"a rounding of both operands and of the difference", 1e-3, 3.0 * eps, 1.0, 1.0, true},
       {"a fast number, located to the resolution of the time", 16.0 * eps, 1e-3, 1.0, 1e-9, true},
       {"a number near zero, at a ten-millionth of its step", 9e-8, 1e-12, 1e-10, 1.0, true},
       {"a truth", 1e-3, 2.0, 1.0, 1.0, false},
       {"a truth a million times in a step", 1e-6, 2.0, 1.0, 1.0, false},
       {"a staircase of the time since 1970", 1.0, 1.0, 1.7e9, 1e4, false},
       {"a number of sixteen digits in the fourteenth digit", 1e-3, 200.0 * eps, 1.0, 1.0, false},
       {"a truth in very short steps", 5e4 * eps, 2.0, 1.0, 1e-9, false}}));
  INFO(row.what);
  const std::int64_t firings = firings_to_end(1.0, row.gap, row.change, row.value, row.step);
  // The first one counts only if its value has hardly changed.
  CHECK(firings >= (row.endless ? thresholds::endless_edges - 1 : 5000));
  CHECK(firings <= (row.endless ? thresholds::endless_edges : 5000));
}

TEST_CASE("A firing that is not close to the last one begins a new series") {
  EdgeSeries series;
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k < 999; ++k) CHECK_FALSE(series.is_endless({1.0 + round, 1.0, 0.0, 1.0}));
    CHECK_FALSE(series.is_endless({1.5 + round, 1.0, 2.0, 1.0}));
    CHECK(series.count == 0);
    CHECK(series.since == 1.5 + round);
  }
}
