// How much a ball keeps of its speed: g and e from noisy heights, and e from the times of impacts.
// The confidence intervals are to have the truth, g = 9.81 m/s^2 and e = 0.8, nineteen times of
// twenty.
#include <saltus/analysis.hpp>
#include <saltus/models/bouncing_ball.hpp>

#include <random>

#include "runner/command_line.hpp"

namespace {

using namespace saltus;

void show(double deviation, unsigned seed) {
  const models::BouncingBall ball;
  const Context start = ball.create_context().with_continuous_state({1.0, 0.0});  // 1 m, at rest
  const Context truth = start.with_parameter("g", 9.81).with_parameter("e", 0.8);
  const std::vector<double> times = [] {
    std::vector<double> all;
    for (int i = 1; i <= 75; ++i) all.push_back(0.02 * i);
    return all;
  }();
  const Results run = simulate(
      ball, truth, {0.0, 1.5},
      {.recorded_signals = {{"state", ball.output(0)}}, .save_at = times, .event_rows = false});
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, deviation);
  Eigen::VectorXd heights = run.output("state").col(0);
  for (double& height : heights) height += noise(random);

  const Experiment seen{
      .time = times, .signals = {{.name = "state[0]", .values = heights, .port = ball.output(0)}}};
  std::cout << fit(ball, start, seen,
                   {{.name = "g", .start = 9.0}, {.name = "e", .lower = 0.1, .upper = 1.0}});

  std::vector<double> impacts = run.events.times("bounce");
  for (double& time : impacts) time = std::round(1000.0 * time) / 1000.0;
  const Experiment heard{.events = {{.name = "bounce", .times = impacts}}};
  std::cout << fit(ball, start, heard, {{.name = "e", .lower = 0.1, .upper = 1.0}});
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("g and e of a ball from noisy heights and from impact times.", "fit");
  double noise = 0.005;
  unsigned seed = 1;
  app.add_option("--noise", noise, "standard deviation of the heights [m]")->capture_default_str();
  app.add_option("--seed", seed, "of the noise")->capture_default_str();
  return examples::guarded(app, argc, argv, [&] { show(noise, seed); });
}
