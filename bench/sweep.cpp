// What does an ensemble cost? It is measured on 10 000 runs of the leaf ball over 5 s with
// different e and y0, final state only: by a hand-written loop over one plan with one simulator,
// and by Ensemble on one thread and on two. bench/sweep.py measures the same by saltus.sweep, in
// turns with this loop.
//
//     sweep                     all in turns, with ratios
//     sweep loop|ensemble [N]   one of them N times, for callgrind; `serve`: times on request
#include <saltus/models/bouncing_ball.hpp>
#include <saltus/simulation/outcomes.hpp>

#include <chrono>
#include <cstdlib>
#include <iostream>

#include "interleave.hpp"

namespace {

using namespace saltus;

constexpr Index e_values = 100, y0_values = 100;
constexpr double t_end = 5.0;

double e_of(Index i) { return 0.5 + 0.4 * static_cast<double>(i) / (e_values - 1); }
double y0_of(Index i) { return 5.0 + 10.0 * static_cast<double>(i) / (y0_values - 1); }

SimulatorOptions options() { return {.record_events = false}; }

class Balls {
 public:
  Balls() : ensemble_(ball_, ball_.create_context(), {0.0, t_end}, options()) {
    std::vector<double> e, y0;
    for (Index i = 0; i < e_values; ++i) {
      for (Index j = 0; j < y0_values; ++j) e.push_back(e_of(i)), y0.push_back(y0_of(j));
    }
    ensemble_.vary("e", std::move(e));
    ensemble_.vary("x[0]", std::move(y0));
  }

  /// The loop that a user of C++ would write without Ensemble.
  double loop() const {
    const Context context = ball_.create_context();
    Simulator simulator(ball_, options());
    double sum = 0.0;
    for (Index i = 0; i < e_values; ++i) {
      for (Index j = 0; j < y0_values; ++j) {
        simulator.initialize(context.with_parameter("e", e_of(i))
                                 .with_continuous_state(Eigen::Vector2d(y0_of(j), 0.0)));
        simulator.advance_to(t_end);
        sum += simulator.results().context.continuous_state()[0];
      }
    }
    return sum;
  }

  double ensemble(int threads) const {
    Outcomes outcomes(ensemble_);
    ensemble_.run([&](Index run, const Results& results) { outcomes.take(run, results); },
                  {.threads = threads});
    double sum = 0.0;
    for (Index i = 0; i < ensemble_.size(); ++i)
      sum += outcomes.continuous_state[2 * static_cast<std::size_t>(i)];
    return sum;
  }

 private:
  models::BouncingBall ball_;
  Ensemble ensemble_;
};

/// [s] Wall time, which threads share.
double seconds(const auto& act) {
  const auto start = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Prints a line "processor wall" for each line read; the other process takes its turn in between.
int serve(const Balls& balls) {
  for (std::string line; std::getline(std::cin, line);) {
    const double before = bench::processor_time();
    const double wall = seconds([&] { balls.loop(); });
    std::cout << bench::processor_time() - before << " " << wall << std::endl;
  }
  return 0;
}

int compare(const Balls& balls) {
  if (balls.loop() != balls.ensemble(1) || balls.loop() != balls.ensemble(2)) {
    std::cerr << "the ensemble does not do what the loop does\n";
    return 1;
  }
  std::vector<double> loop, one, two;
  for (int round = 0; round < 15; ++round) {
    loop.push_back(seconds([&] { balls.loop(); }));
    one.push_back(seconds([&] { balls.ensemble(1); }) / loop.back());
    two.push_back(seconds([&] { balls.ensemble(2); }) / loop.back());
  }
  const double base = bench::median(loop);
  std::cout << "10000 leaf balls over " << t_end << " s\n"
            << "loop, one plan      " << 1e3 * base << " ms\n"
            << "Ensemble, 1 thread  " << bench::median(one) << " of it\n"
            << "Ensemble, 2 threads " << bench::median(two) << " of it\n";
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  const Balls balls;
  const std::string what = count > 1 ? arguments[1] : "";
  const int times = count > 2 ? std::atoi(arguments[2]) : 1;
  if (what == "serve") return serve(balls);
  if (what.empty()) return compare(balls);
  double sum = 0.0;
  for (int i = 0; i < times; ++i) sum += what == "loop" ? balls.loop() : balls.ensemble(1);
  std::cout << sum << "\n";
}
