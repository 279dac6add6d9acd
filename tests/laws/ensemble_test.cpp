// An ensemble: each of its runs is the run one would have made alone, bit for bit, whatever the
// number of threads and whatever ran before it.
#include <atomic>

#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/shelf.hpp"
#include "saltus/simulation/outcomes.hpp"
#include "support/allocations.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;
using support::Leaf;
using support::vec;

namespace {

/// e from 0 to 1, y0 from 1 m on; entries that land and entries that rest.
Ensemble balls(const System& ball, Index runs, SimulatorOptions options = {}) {
  Ensemble ensemble(ball, ball.create_context(), {0.0, 5.0}, std::move(options));
  std::vector<double> e, y0;
  for (Index i = 0; i < runs; ++i) {
    e.push_back(static_cast<double>(i) / static_cast<double>(runs));
    y0.push_back(1.0 + static_cast<double>(i % 7));
  }
  ensemble.vary("e", e);
  ensemble.vary("x[0]", y0);
  return ensemble;
}

Outcomes outcomes_of(const Ensemble& ensemble, int threads, std::vector<double> times = {}) {
  Outcomes outcomes(ensemble, std::move(times));
  const Index done =
      ensemble.run([&](Index run, const Results& results) { outcomes.take(run, results); },
                   {.threads = threads});
  CHECK(done == ensemble.size());
  return outcomes;
}

bool says(const std::string& message, std::string_view part) {
  INFO(message);
  return message.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("runs of an ensemble are the runs made alone", "[ensemble]") {
  const models::BouncingBall ball;
  const Ensemble ensemble = balls(ball, 50);
  for (const int threads : {1, 2, 3, 0}) {
    const Outcomes outcomes = outcomes_of(ensemble, threads);
    for (Index run = 0; run < ensemble.size(); ++run) {
      INFO(threads << " threads, run " << run);
      const Results alone = simulate(ball, ensemble.context(run), {0.0, 5.0});
      const auto k = static_cast<std::size_t>(run);
      CHECK(outcomes.status[k] == static_cast<int>(alone.status));
      CHECK(outcomes.continuous_state[2 * k] == alone.context.continuous_state()[0]);
      CHECK(outcomes.continuous_state[2 * k + 1] == alone.context.continuous_state()[1]);
      CHECK(outcomes.events[k] == alone.statistics.events);
      CHECK(outcomes.steps[k] == alone.statistics.steps);
    }
  }
}

TEST_CASE("a run leaves nothing behind for the next one of its thread", "[ensemble]") {
  // each scene of the shelf that takes little time, by each method that suits it: alone, and after
  // runs from other values
  for (const auto& entry : models::shelf()) {
    const saltus::Scene scene = models::scene(entry.name);
    const Index n = scene.context.continuous_state().size();
    if (n > 40 || entry.name == "vdpol-1e6" || entry.name == "thermostat") continue;
    for (const Method method : scene.methods) {
      INFO(entry.name << ", method " << method);
      SimulatorOptions options = scene.options;
      options.ode_solver_method = method;
      options.throw_errors = false;
      const double end = scene.span.begin + 0.3 * (scene.span.end - scene.span.begin);
      Ensemble ensemble(*scene.system, scene.context, {scene.span.begin, end}, options);
      std::vector<double> start;
      const auto& x = scene.context.continuous_state();
      for (const double factor : {1.001, 1.0, 0.999, 1.0})
        for (const double value : x) start.push_back(factor * value);
      if (scene.context.layout().leaves.size() > 1) continue;  // its state has no one name
      ensemble.vary("x", start, n);
      const Results alone =
          simulate(*scene.system, scene.context, {scene.span.begin, end}, options);
      const Outcomes outcomes = outcomes_of(ensemble, 1);
      for (const std::size_t run : {std::size_t{1}, std::size_t{3}}) {
        for (Index i = 0; i < n; ++i) {
          CHECK(outcomes.continuous_state[run * static_cast<std::size_t>(n) +
                                          static_cast<std::size_t>(i)] ==
                alone.context.continuous_state()[i]);
        }
        CHECK(outcomes.steps[run] == alone.statistics.steps);
      }
    }
  }
}

TEST_CASE("signals are kept at common times, after the events there", "[ensemble]") {
  // dropped from 4.905 m a ball lands at 1 s exactly; at rest (e = 0) it stays there
  const models::BouncingBall ball;
  Ensemble ensemble(ball, ball.create_context().with_continuous_state({4.905, 0.0}), {0.0, 3.0},
                    {.recorded_signals = {{"y", ball.output(0)}}, .save_at = {0.5, 1.5, 2.5}});
  ensemble.vary("e", {0.0, 1.0});
  const Outcomes outcomes = outcomes_of(ensemble, 2, {0.5, 1.5, 2.5});
  REQUIRE(outcomes.signals.size() == 1);
  const auto y = [&](std::size_t run, std::size_t k) {
    return outcomes.signals[0].values[2 * (3 * run + k)];
  };
  // 1e-6: rtol of the default options, on heights of some metres
  CHECK_THAT(y(0, 0), WithinAbs(4.905 * 0.75, 1e-5));
  CHECK_THAT(y(0, 1), WithinAbs(0.0, 1e-5));
  CHECK_THAT(y(1, 1), WithinAbs(4.905 * 0.75, 1e-5));
  CHECK_THAT(y(1, 2), WithinAbs(4.905 * 0.75, 1e-5));
}

TEST_CASE("a run that fails keeps its reason and harms no other", "[ensemble]") {
  const Leaf leaf("fuse", [](Leaf& l) {
    const ParameterIndex limit = l.declare_dynamic_parameter("limit", 1.0);
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [limit](const At& at) {
                                  if (at.x[0] > at.p[limit])
                                    throw std::runtime_error("the fuse blew");
                                  return 1.0;
                                }});
  });
  Ensemble ensemble(leaf, leaf.create_context(), {0.0, 2.0});
  ensemble.vary("limit", {3.0, 1.0, 4.0, std::nan(""), 5.0});
  for (const int threads : {1, 2}) {
    const Outcomes outcomes = outcomes_of(ensemble, threads);
    CHECK(outcomes.message[1] == "the fuse blew");
    CHECK(says(outcomes.message[3], "'limit' is nan"));
    for (const std::size_t run : {1, 3}) {
      CHECK(outcomes.status[run] == static_cast<int>(Status::failed));
      CHECK(std::isnan(outcomes.continuous_state[run]));
    }
    for (const std::size_t run : {0, 2, 4}) {
      CHECK(outcomes.status[run] == static_cast<int>(Status::reached_end));
      CHECK_THAT(outcomes.continuous_state[run], WithinAbs(2.0, 1e-12));  // f is constant
    }
  }
}

TEST_CASE("an ensemble that is stopped says what was not run", "[ensemble]") {
  const models::BouncingBall ball;
  const Ensemble ensemble = balls(ball, 1'000'000, {.rtol = 1e-10});
  for (const int threads : {1, 2}) {
    Outcomes outcomes(ensemble);
    const Index done =
        ensemble.run([&](Index run, const Results& results) { outcomes.take(run, results); },
                     {.threads = threads, .watch = [](Index) { return true; }});
    CHECK(done > 0);
    CHECK(done < ensemble.size());
    CHECK(outcomes.status.back() == Outcomes::not_run);
    CHECK(std::isnan(outcomes.continuous_state.back()));
  }
}

TEST_CASE("what takes the outcome may throw", "[ensemble]") {
  const models::BouncingBall ball;
  const Ensemble ensemble = balls(ball, 100);
  for (const int threads : {1, 2}) {
    std::atomic<int> taken = 0;
    const auto take = [&](Index, const Results&) {
      if (++taken == 10) throw std::domain_error("enough");
    };
    CHECK_THROWS_AS(ensemble.run(take, {.threads = threads}), std::domain_error);
    CHECK(taken < 100);
  }
}

TEST_CASE("names and widths that do not fit are refused", "[ensemble][errors]") {
  const models::BouncingBall ball;
  Ensemble ensemble(ball, ball.create_context(), {0.0, 1.0});
  const auto message = [&](std::string_view name, std::vector<double> values, Index width = 1) {
    try {
      ensemble.vary(name, std::move(values), width);
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  CHECK(says(message("x[9]", {1.0}), "'x' has 2 entries"));
  CHECK(says(message("ee", {1.0}), "did you mean 'e'?"));
  CHECK(says(message("x", {1.0, 2.0, 3.0}, 3), "expected 2 values, found 3"));
  ensemble.vary("ball.e", {0.5, 0.6});
  CHECK(says(message("g", {9.81}), "for each of 2 runs"));
  CHECK(says(message("e", {0.5, 0.6}), "are the same values"));
  CHECK_THROWS_AS(Ensemble(ball, ball.create_context(), {1.0, 0.0}), ModelError);
  const Leaf other("other", [](Leaf& l) { support::declare_ramp(l); });
  CHECK_THROWS_AS(Ensemble(ball, other.create_context(), {0.0, 1.0}), ModelError);
}

TEST_CASE("a thread asks for the same memory in each run", "[ensemble][allocation]") {
  const models::BouncingBall ball;
  const auto memory_of = [&](Index runs) {
    const Ensemble ensemble = balls(ball, runs, {.record_events = false});
    Outcomes outcomes(ensemble);
    return support::allocations_of([&] {
      ensemble.run([&](Index run, const Results& results) { outcomes.take(run, results); });
    });
  };
  memory_of(10);
  const long ten = memory_of(10), more = memory_of(1010);
  INFO(ten << " and " << more);
  // The context before and after the run: x, parameters, modes and the continuation, each with
  // its few lists; nothing that grows.
  CHECK(more - ten <= 1000 * 20);
}
