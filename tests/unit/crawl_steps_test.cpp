// Crawl: which very short steps slide along a jump of the derivative.
#include "saltus/simulation/detail/crawl.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Steps of 1e-9 s around x = 0 in a run of 1 s; whether they slide along a jump of x' = f(x).
template <class F>
std::pair<bool, Crawl::Jump> slides(F f, double step = 1e-9, double length = 1.0) {
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [f](const At& at, VectorRef xdot) {
                                  xdot[0] = f(at.x[0]);
                                }});
  });
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  Crawl crawl(machine);
  crawl.begin(0.0);
  double t = 0.0;
  for (int i = 0; i < 10000; ++i) {
    t += step;
    const double x = (i % 2 == 0 ? 1.0 : -1.0) * step;  // from one side of zero to the other
    if (crawl.looks(t, length) && crawl.found(t, vec({x}))) return {true, crawl.jump()};
  }
  return {false, {}};
}

}  // namespace

TEST_CASE("a solution that goes back and forth across a jump slides along it", "[crawl]") {
  const auto [found, jump] = slides([](double x) { return x > 0.0 ? -1.0 : 2.0; });
  REQUIRE(found);
  CHECK(jump.state == 0);
  CHECK(std::abs(jump.at) < 1e-30);
  CHECK(std::min(jump.below, jump.above) == -1.0);
  CHECK(std::max(jump.below, jump.above) == 2.0);
  CHECK(jump.steps < 2000);  // the window, and some looks
}

TEST_CASE("a derivative that changes gradually is no jump, however steep it is", "[crawl]") {
  CHECK_FALSE(slides([](double x) { return -1e9 * x; }).first);
  CHECK_FALSE(slides([](double x) { return -std::tanh(1e12 * x); }).first);
}

TEST_CASE("a derivative that keeps its sign across a jump lets the solution pass", "[crawl]") {
  CHECK_FALSE(slides([](double x) { return x > 0.0 ? 1.0 : 2.0; }).first);
}

TEST_CASE("steps that are no part of a crawl are not looked at", "[crawl]") {
  // A thousand of them are the whole run.
  CHECK_FALSE(slides([](double x) { return x > 0.0 ? -1.0 : 2.0; }, 1e-3, 1.0).first);
}

TEST_CASE("a derivative that is not defined ahead is no jump", "[crawl]") {
  CHECK_FALSE(slides([](double x) -> double {
                if (std::abs(x) > 5e-9) throw std::runtime_error("undefined");
                return x > 0.0 ? -1.0 : 2.0;
              }).first);
}
