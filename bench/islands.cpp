// What do n balls in one scene cost, a leaf each, if their islands step apart? Beside it n runs of a
// single ball, and the scene with one common step.
//
//     build/bench/bin/islands                        the table: ratios of processor time, in turns
//     build/bench/bin/islands apart|single|common n  one run, for callgrind
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "ball.hpp"
#include "interleave.hpp"
#include "runner.hpp"

using namespace saltus;

namespace {

constexpr double end = 3.0;  // [s]

/// Balls with drag, so that a flight takes steps, and heights that differ: no two bounce together.
bench::Ball ball() { return {.k = 0.1}; }
double height(int i) { return 1.0 + 0.618 * i - std::floor(0.618 * i); }  // [m]

SimulatorOptions options(bool islands) {
  return {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5, .islands = islands};
}

class Named final : public LeafSystem {
 public:
  explicit Named(std::string name) : LeafSystem(std::move(name)) {
    declare_continuous_state(2, method<&Named::ode>);
    declare_zero_crossing({.name = "bounce",
                           .guard = method<&Named::at_height>,
                           .reset_map = method<&Named::bounce>,
                           .direction = Direction::positive_then_non_positive});
  }

 private:
  void ode(const At& at, VectorRef xdot) const { ball().derivative(at.x.data(), xdot.data()); }
  double at_height(const At& at) const { return at.x[0]; }
  void bounce(const At& at, Next& next) const {
    next.set_continuous_state({std::abs(at.x[0]), -0.9 * at.x[1]});
  }
};

std::shared_ptr<const System> scene(int n) {
  DiagramBuilder builder;
  for (int i = 0; i < n; ++i) builder.add(std::make_shared<Named>(text("ball_", i)));
  return std::make_shared<Diagram>(builder.build());
}

Context start(const System& system, int n) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * n);
  for (int i = 0; i < n; ++i) x[2 * i] = height(i);
  return system.create_context().with_continuous_state(x);
}

bench::Runner together(int n, bool islands) {
  const auto system = scene(n);
  return {system, start(*system, n), end, options(islands)};
}

/// n runs of one simulator of one ball.
class Singles {
 public:
  explicit Singles(int n) : simulator_(ball_, options(false)) {
    for (int i = 0; i < n; ++i)
      starts_.push_back(
          ball_.create_context().with_continuous_state(Eigen::Vector2d(height(i), 0.0)));
  }
  void operator()() {
    events_ = 0;
    for (const Context& start : starts_) {
      simulator_.initialize(start);
      simulator_.advance_to(end);
      events_ += simulator_.results().statistics.events;
    }
  }
  std::int64_t events() const { return events_; }

 private:
  Named ball_{"ball"};
  Simulator simulator_;
  std::vector<Context> starts_;
  std::int64_t events_ = 0;
};

void row(int n) {
  Singles singles(n);
  bench::Runner apart = together(n, true);
  std::vector<std::function<void()>> runners{[&] { singles(); }, [&] { apart(); }};
  std::optional<bench::Runner> common;
  if (n <= 1000) common.emplace(together(n, false)), runners.emplace_back([&] { (*common)(); });
  const auto timings = bench::interleave(runners, n > 1000 ? 5 : n > 100 ? 7 : 21);
  if (singles.events() != apart.statistics().events)
    std::printf("the islands have %ld events, the single balls %ld\n",
                static_cast<long>(apart.statistics().events), static_cast<long>(singles.events()));
  std::printf("| %6d | %8.3f | %8.3f | %5.2f |", n, 1e3 * timings[0].time, 1e3 * timings[1].time,
              timings[1].ratio);
  if (common)
    std::printf(" %9.3f | %6.1f |\n", 1e3 * timings[2].time, timings[2].ratio);
  else
    std::printf("         - |      - |\n");
}

int one_run(const char* what, int n) {
  if (std::strcmp(what, "single") == 0) return Singles(n)(), 0;
  const bool islands = std::strcmp(what, "apart") == 0;
  bench::Runner run = together(n, islands);
  run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3) return one_run(argv[1], std::atoi(argv[2]));
  std::printf("|  balls | single [ms] | islands [ms] | ratio | common step [ms] | ratio |\n");
  std::printf("| -----: | -----: | -----: | -----: | -----: | -----: |\n");
  for (const int n : {1, 10, 100, 1000, 10000}) row(n);
}
