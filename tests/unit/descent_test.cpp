// Descent: to the least value of a guard, by its slope.
#include "saltus/solver/detail/descent.hpp"

#include <functional>

#include "support/catch.hpp"

using namespace saltus;

namespace {

struct Way {
  double least;  ///< the lowest value that was looked at
  int looks;
};

/// Follows g from `first` in [0, 1] until it is below zero; `bend` as a parabola might have it.
Way follow(const std::function<double(double)>& g, double first, double bend) {
  constexpr double later = 1e-6;
  Descent descent(0.0, 1.0, first, bend);
  Way way{g(descent.at()), 1};
  while (way.looks < 20 && !(way.least < 0.0)) {
    const double u = descent.at(), beside = u + later < 1.0 ? later : -later;
    if (!descent.take(g(u), (g(u + beside) - g(u)) / beside, 0.5 * beside)) break;
    way.least = std::min(way.least, g(descent.at())), ++way.looks;
  }
  return way;
}

}  // namespace

TEST_CASE("the way of the slope to a dip takes a few looks", "[descent]") {
  const auto smooth = [](double u) { return std::cosh(3.0 * (u - 0.6)) - 1.0; };
  const auto kink = [](double u) { return std::abs(u - 0.6); };
  const auto lopsided = [](double u) { return std::exp(4.0 * u - 2.4) - 4.0 * u + 1.4; };
  struct Row {
    const char* name;
    std::function<double(double)> g;
    double depth, first, bend;
    int looks;
  };
  for (const Row& row : {Row{"smooth", smooth, 1e-3, 0.4, 4.5, 2},
                         {"smooth", smooth, 1e-9, 0.4, 4.5, 4},
                         {"smooth, from an end", smooth, 1e-9, -1.0, 4.5, 6},
                         {"smooth, from the other end", smooth, 1e-9, 2.0, 4.5, 6},
                         {"another bend", smooth, 1e-9, 0.4, 1.5, 5},
                         {"lopsided", lopsided, 1e-7, 0.3, 3.0, 7},
                         {"a kink", kink, 0.06, 0.3, 1.0, 6}}) {
    INFO(row.name << ", " << row.depth << " below zero");
    const Way way = follow([&](double u) { return row.g(u) - row.depth; }, row.first, row.bend);
    CHECK(way.least < 0.0);
    CHECK(way.looks <= row.looks);
  }
}

TEST_CASE("a valley above zero, and one beside the part, are left at once", "[descent]") {
  const auto valley = [](double at, double above) {
    return [=](double u) { return (u - at) * (u - at) + above; };
  };
  CHECK(follow(valley(0.6, 0.01), 0.55, 1.0).looks == 1);
  CHECK(follow(valley(1.2, -0.001), 1.2, 1.0).looks == 1);
  CHECK(follow(valley(-0.2, -0.001), -0.2, 1.0).looks == 1);
  CHECK(follow([](double) { return std::nan(""); }, 0.5, 1.0).looks == 1);
}
