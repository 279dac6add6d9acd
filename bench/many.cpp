// How does the cost grow with size? 1 to 1000 balls, as one leaf with a vector guard and as a leaf
// each; 12 to 12 288 blocks in a chain of lags, x_i' = k (x_{i-1} - x_i). dopri5 at rtol 1e-6. The
// time of a step divided by the size shows whether growth is linear.
#include <saltus/library/library.hpp>

#include "ball.hpp"
#include "balls.hpp"
#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using bench::Runner;
using namespace saltus;

constexpr double g = 9.81, e = 0.9, balls_end = 2.0;

SimulatorOptions dopri5() {
  return {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5};
}

double height_of(int i, int n) { return 10.0 + 5.0 * i / n; }  // [m] no two land together

std::shared_ptr<bench::Balls> balls(int n) {
  Eigen::VectorXd heights(n);
  for (int i = 0; i < n; ++i) heights[i] = height_of(i, n);
  return std::make_shared<bench::Balls>(heights);
}

class OneBall final : public LeafSystem {
 public:
  OneBall(std::string name, double y0) : LeafSystem(std::move(name)) {
    declare_continuous_state({.initial = Eigen::Vector2d(y0, 0.0),
                              .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    declare_zero_crossing({.name = "bounce",
                           .guard = [](const At& at) { return at.x[0]; },
                           .reset_map =
                               [](const At& at, Next& next) {
                                 next.set_continuous_state({std::abs(at.x[0]), -e * at.x[1]});
                               },
                           .direction = Direction::positive_then_non_positive});
  }
};

std::shared_ptr<const System> leaves(int n) {
  DiagramBuilder builder;
  for (int i = 0; i < n; ++i) builder.add<OneBall>(text("ball_", i), height_of(i, n));
  return std::make_shared<const Diagram>(builder.build("balls"));
}

std::shared_ptr<const System> chain(int lags) {
  DiagramBuilder builder;
  OutputPort before = builder.add<Sine>("sine", Sine::Options{}).output();
  for (int i = 0; i < lags; ++i) {
    auto& difference = builder.add<Adder>(text("difference_", i), "+-");
    auto& rate = builder.add<Gain>(text("rate_", i), 2.0);
    auto& lag = builder.add<Integrator>(text("lag_", i), Integrator::Options{});
    builder.connect(before, difference.input(0));
    builder.connect(lag.output(), difference.input(1));
    builder.connect(difference.output(), rate.input());
    builder.connect(rate.output(), lag.input());
    before = lag.output();
  }
  return std::make_shared<const Diagram>(builder.build("chain"));
}

/// The plan's time, and the time of a step; returns both [s].
std::pair<double, double> measure(bench::Sheet& sheet, const char* what, int n,
                                  const std::shared_ptr<const System>& system, double t_end) {
  const Context start = system->create_context();
  Runner run(system, start, t_end, dopri5());
  const int rounds = n >= 1000 ? 5 : 15;
  const double plan =
      bench::interleave({[&] { Simulator(*system, dopri5()); }}, rounds).front().time;
  const double time = bench::interleave({[&] { run(); }}, rounds).front().time;
  const double step = time / static_cast<double>(run.statistics().steps);
  sheet.add({{"what", what},
             {"n", n},
             {"plan [us]", plan * 1e6},
             {"run [ms]", time * 1e3},
             {"steps", run.statistics().steps},
             {"events", run.results().events.size()},
             {"step [us]", step * 1e6},
             {"step / n [ns]", step / n * 1e9}});
  return {plan, step};
}

/// The exponent of n between the last two sizes; small sizes show the fixed cost, not the growth.
void grow(bench::Sheet& sheet, const char* what, const std::vector<int>& sizes, double t_end,
          const std::function<std::shared_ptr<const System>(int)>& make) {
  std::vector<std::pair<double, double>> found;
  for (const int n : sizes) found.push_back(measure(sheet, what, n, make(n), t_end));
  const double decade = std::log(static_cast<double>(sizes.back()) / sizes[sizes.size() - 2]);
  const auto [plan, step] = found.back();
  const auto [plan_before, step_before] = found[found.size() - 2];
  sheet.target(text(what, ": exponent of n in the time of a plan"),
               std::log(plan / plan_before) / decade, 1.2);
  sheet.target(text(what, ": exponent of n in the time of a step"),
               std::log(step / step_before) / decade, 1.2);
}

}  // namespace

int main() {
  bench::Sheet sheet("many", "How does the engine grow with balls and blocks?");
  const std::vector<int> counts{1, 10, 100, 1000};
  grow(sheet, "balls in one leaf", counts, balls_end, balls);
  grow(sheet, "a leaf for each ball", counts, balls_end, leaves);
  grow(sheet, "lags, three blocks each", {4, 32, 256, 1024, 4096}, 5.0, chain);
}
