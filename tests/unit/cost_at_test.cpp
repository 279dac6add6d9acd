// The cost of a solver at an achieved error (bench/cost_at.hpp), from runs at some tolerances.
#include "cost_at.hpp"

#include "support/catch.hpp"

using bench::cost_at;
using bench::CostPoint;
using Catch::Matchers::WithinRel;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Row {
  const char* what;
  double error;
  std::vector<CostPoint> points;
  double cost;
};

}  // namespace

TEST_CASE("cost at an error: the line in logarithms, or the cheapest run that is exact enough") {
  const Row row = GENERATE(
      Row{"no runs", 1e-6, {}, infinite},
      Row{"none is exact enough", 1e-6, {{1e-4, 1}, {1e-5, 2}}, infinite},
      Row{"the loosest already is", 1e-2, {{1e-4, 1}, {1e-6, 2}}, 1},
      Row{"exactly at a run", 1e-6, {{1e-4, 1}, {1e-6, 2}}, 2},
      Row{"half way, a power law", 1e-5, {{1e-4, 1}, {1e-6, 4}}, 2},
      Row{"a tighter run that is cheaper counts", 1e-5, {{1e-4, 1}, {1e-6, 4}, {1e-9, 1.5}}, 1.5},
      Row{"the error rises and falls again", 1e-5, {{1e-6, 3}, {1e-4, 1}, {1e-6, 4}}, 2},
      Row{"the run before gave up", 1e-5, {{infinite, 1}, {1e-6, 4}}, 4},
      Row{"an error that is no number is no answer",
          1e-5,
          {{std::nan(""), 1}, {1e-4, 4}},
          infinite},
      Row{"the run before is no number", 1e-5, {{std::nan(""), 1}, {1e-6, 4}}, 4});
  INFO(row.what);
  // Two logarithms and a power: some roundings.
  CHECK_THAT(cost_at(row.error, row.points), WithinRel(row.cost, 1e-14));
}
