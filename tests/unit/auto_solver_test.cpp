// "auto": hands over to a stiff method and back, loses no event on the way, and costs little more
// than the method that suits.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

Results run(const Leaf& leaf, double t_end, Method method, double rtol = 1e-6, double atol = 1e-6,
            RecordedSignals record = {}) {
  return simulate(leaf, leaf.create_context(), {0.0, t_end},
                  {.rtol = rtol,
                   .atol = atol,
                   .ode_solver_method = method,
                   .recorded_signals = std::move(record)});
}

std::vector<std::string> methods_of(const Results& results) {
  std::vector<std::string> all;
  for (const Stretch& stretch : results.statistics.stretches) all.push_back(stretch.method);
  return all;
}

bool is_stiff(const Stretch& stretch) {
  return stretch.method == "bdf" || stretch.method == "radau";
}

auto calls(const Results& results) { return results.statistics.right_hand_side_calls; }

/// An oscillator, and x2' = rate (cos t - x2): rate 1 in mode 0, 1e6 in mode 1; a switch every
/// second until t = 6.
Leaf two_modes() {
  return Leaf("two_modes", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0, 1.0}), .ode = [](const At& at, VectorRef xdot) {
           const double rate = at.mode == 1 ? 1e6 : 1.0;
           xdot << 6.0 * at.x[1], -6.0 * at.x[0], rate * (std::cos(at.time) - at.x[2]);
         }});
    l.declare_default_mode(0);
    for (int i = 0; i < 6; ++i)
      l.declare_zero_crossing({.name = text("switch_", i + 1),
                               .guard = [i](const At& at) { return at.time - (i + 1.0); },
                               .start_mode = i % 2,
                               .end_mode = 1 - i % 2});
  });
}

template <class More>
Leaf van_der_pol(double mu, More more) {
  return Leaf("van_der_pol", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({2.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], mu * (1.0 - at.x[0] * at.x[0]) * at.x[1] - at.x[0];
         }});
    l.declare_continuous_state_output("x");
    l.declare_discrete_state(vec({0.0}));
    more(l);
  });
}
Leaf van_der_pol(double mu) {
  return van_der_pol(mu, [](Leaf&) {});
}

Leaf robertson() {
  return Leaf("robertson", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           const double decay = 0.04 * at.x[0], back = 1e4 * at.x[1] * at.x[2],
                        on = 3e7 * at.x[1] * at.x[1];
           xdot << back - decay, decay - back - on, on;
         }});
  });
}

}  // namespace

TEST_CASE("auto follows a scene whose modes are stiff in turns, and every switch is exact",
          "[auto]") {
  const double rtol = GENERATE(1e-4, 1e-6, 1e-10);
  INFO("rtol " << rtol);
  const Leaf leaf = two_modes();
  const auto results = run(leaf, 7.0, Method::automatic, rtol, rtol),
             radau = run(leaf, 7.0, Method::radau, rtol, rtol);
  const auto& stretches = results.statistics.stretches;
  REQUIRE(results.events.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const double t = static_cast<double>(i) + 1.0;
    CHECK_THAT(results.events[i].time, WithinAbs(t, 100.0 * eps * (t + 1.0)));
  }
  std::int64_t steps = stretches[0].steps;
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    CHECK(stretches[i].begin == stretches[i - 1].end);
    CHECK(is_stiff(stretches[i]) == (i % 2 == 1));
    steps += stretches[i].steps;
  }
  for (int i = 0; i < 7; ++i) {
    const auto middle = std::ranges::find_if(
        stretches, [i](const Stretch& s) { return s.begin <= i + 0.5 && i + 0.5 < s.end; });
    REQUIRE(middle != stretches.end());
    CHECK(is_stiff(*middle) == (i % 2 == 1));
    // Radau begins when a step or two have shown what is up, the other one at once. Between them a
    // transient of 10 / 1e6 s may be the explicit method's after all, at tight tolerance.
    CHECK_THAT(middle->begin, WithinAbs(i, 1e-3));
  }
  CHECK(stretches.size() <= 13);
  CHECK(stretches.back().end == 7.0);
  CHECK(steps == results.statistics.steps);
  CHECK(results.statistics.restarts == radau.statistics.restarts);  // none for a change of method
  // dopri5 alone would need 6 calls for each 3.3e-6 s of the stiff modes, so Radau is the best. The
  // calls beyond its own are those of the stiffness test at each of the three changes.
  CHECK(static_cast<double>(calls(results)) < 1.5 * static_cast<double>(calls(radau)));
  // The oscillator keeps its amplitude, but for an error of a step, sqrt(3) (atol + rtol) at most,
  // times the steps.
  CHECK_THAT(results.context.continuous_state().head(2).norm(),
             WithinAbs(1.0, std::sqrt(3.0) * 2.0 * rtol * static_cast<double>(steps)));
}

TEST_CASE("auto hands back inside a stretch when the scene stops being stiff", "[auto]") {
  // x' = L(t) (cos 10 t - x): L falls from 1e6 to 1 between t = 1 and t = 2 and stays there to t =
  // 60.
  const Leaf leaf("thaw", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                  const double fall = std::clamp(2.0 - at.time, 0.0, 1.0);
                                  return std::exp(13.8 * fall) *
                                         (std::cos(10.0 * at.time) - at.x[0]);
                                }});
  });
  const auto results = run(leaf, 60.0, Method::automatic);
  CHECK(methods_of(results) == std::vector<std::string>{"dopri5", "radau", "dopri5"});
  CHECK(contains(results.statistics.method, "dopri5, then radau from t = "));
  CHECK(contains(results.statistics.method, "the scene no longer does"));
  CHECK(calls(results) < calls(run(leaf, 60.0, Method::dopri5)) / 100);
}

TEST_CASE("auto does not play ball between the methods where a scene is hardly stiff", "[auto]") {
  const double mu = GENERATE(3.0, 10.0, 30.0, 100.0);
  const double rtol = GENERATE(1e-3, 1e-6, 1e-9, 1e-12);
  INFO("mu " << mu << ", rtol " << rtol);
  const Leaf leaf = van_der_pol(mu);
  const auto results = run(leaf, 10.0 * mu, Method::automatic, rtol, rtol);
  // Ten mu are 6.2 periods at most, with two creeps and two jumps each: one change of method for
  // each is what the solution itself asks for, and one at the start.
  CHECK(results.statistics.stretches.size() <= 27);
  const auto best = std::min(calls(run(leaf, 10.0 * mu, Method::dopri5, rtol, rtol)),
                             std::min(calls(run(leaf, 10.0 * mu, Method::dop853, rtol, rtol)),
                                      calls(run(leaf, 10.0 * mu, Method::bdf, rtol, rtol))));
  INFO("calls " << calls(results) << ", best " << best << ": " << results.statistics.method);
  CHECK(calls(results) < 3 * best);
}

TEST_CASE("a guard fires once wherever it stands around a change of method", "[auto]") {
  const Leaf plain = van_der_pol(1000.0);
  const auto free = run(plain, 100.0, Method::automatic, 1e-6, 1e-8, {{"x", plain.output()}});
  REQUIRE(methods_of(free) == std::vector<std::string>{"dopri5", "radau"});
  const double change = free.statistics.stretches[0].end;
  const auto x = column(free, "x");
  const auto at = static_cast<std::size_t>(std::ranges::find(free.time, change) -
                                           free.time.begin());  // the row of the change
  REQUIRE(at + 4 < free.time.size());
  for (std::size_t row = at - 3; row < at + 4; ++row) {
    for (const double between : {0.0, 0.5}) {
      const double level = x[row] + between * (x[row + 1] - x[row]);
      INFO("row " << row << ", change at row " << at << ", level " << level);
      const auto guarded = [&](bool monitor, bool terminal) {
        const Leaf leaf = van_der_pol(1000.0, [=](Leaf& l) {
          l.declare_zero_crossing(
              {.name = "level",
               .guard = [=](const At& a) { return a.x[0] - level; },
               .reset_map = monitor || terminal ? ResetMap{} : ResetMap{count_up},
               .direction = Direction::positive_then_non_positive,
               .terminal = terminal});
        });
        return run(leaf, 100.0, Method::automatic, 1e-6, 1e-8);
      };
      // x is exact to the last bits where a row stands; between rows it is as good as the step:
      // half a step either way.
      const double early = free.time[row], late = free.time[row + 1];
      const double slack = 0.5 * (late - early) + 1e-9;
      const auto seen = guarded(true, false), counted = guarded(false, false),
                 stopped = guarded(false, true);
      REQUIRE(seen.events.size() == 1);
      REQUIRE(counted.events.size() == 1);
      CHECK(counted.context.discrete_state()[0] == 1.0);
      REQUIRE(stopped.status == Status::terminal);
      for (const double t : {seen.events[0].time, counted.events[0].time, stopped.context.time()}) {
        CHECK(t > early - slack);
        CHECK(t < late + slack);
      }
      // A monitor changes nothing.
      CHECK(seen.context.continuous_state() == free.context.continuous_state());
    }
  }
}

TEST_CASE("auto costs half more than Radau at most on Robertson's reaction, at any tolerance",
          "[auto]") {
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8, 1e-10);
  INFO("rtol " << rtol);
  const Leaf leaf = robertson();
  const auto results = run(leaf, 4e10, Method::automatic, rtol, 1e-4 * rtol),
             radau = run(leaf, 4e10, Method::radau, rtol, 1e-4 * rtol);
  CHECK(methods_of(results).back() == "radau");
  // Beyond those of Radau: the fifteen steps of the stiffness test, and four calls every 25 steps.
  CHECK(static_cast<double>(calls(results)) < 1.5 * static_cast<double>(calls(radau)));
}

TEST_CASE("auto takes order 8 where that pays, and names its one stretch", "[auto]") {
  const Leaf mild = van_der_pol(1.0);
  const auto with_guard = van_der_pol(1.0, [](Leaf& l) {
    l.declare_zero_crossing(
        {.name = "zero", .guard = [](const At& at) { return at.x[0]; }, .reset_map = count_up});
  });
  const auto one = [](const Leaf& leaf, double rtol) {
    const auto results = run(leaf, 50.0, Method::automatic, rtol, rtol);
    REQUIRE(results.statistics.stretches.size() == 1);
    const Stretch& only = results.statistics.stretches[0];
    CHECK(only.begin == 0.0);
    CHECK(only.end == 50.0);
    CHECK(only.steps == results.statistics.steps);
    CHECK(only.method == results.statistics.method);
    CHECK(results.statistics.linear_setups == 0);
    return only.method;
  };
  CHECK(one(mild, 1e-6) == "dopri5");
  CHECK(one(mild, 1e-7) == "dop853");
  CHECK(one(with_guard, 1e-9) == "dopri5");  // each step is looked into, and may be cut short
  CHECK(one(with_guard, 1e-10) == "dop853");
}

TEST_CASE("auto sees that Van der Pol with mu = 1000 is stiff and hands over to Radau", "[auto]") {
  const Leaf stiff = van_der_pol(1000.0);
  const auto results = simulate(stiff, stiff.create_context(), {0.0, 2000.0},
                                {.ode_solver_method = Method::automatic});
  CHECK(contains(results.statistics.method, "dopri5, then radau"));
  CHECK(results.statistics.steps < 10000);  // dopri5 alone takes millions
  const auto bdf =
      simulate(stiff, stiff.create_context(), {0.0, 2000.0}, {.ode_solver_method = Method::bdf});
  CHECK(std::abs(results.context.continuous_state()[0] - bdf.context.continuous_state()[0]) < 1e-2);
}

TEST_CASE("auto stays with dopri5 where nothing is stiff", "[auto]") {
  const Leaf mild = van_der_pol(1.0);
  CHECK(
      simulate(mild, mild.create_context(), {0.0, 200.0}, {.ode_solver_method = Method::automatic})
          .statistics.method == "dopri5");
  const Leaf fast("fast", [](Leaf& l) {  // fast, but as fast as its solution
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << 1e4 * at.x[1], -1e4 * at.x[0]; }});
  });
  CHECK(simulate(fast, fast.create_context(), {0.0, 0.1}, {.ode_solver_method = Method::automatic})
            .statistics.method == "dopri5");
}

namespace {

/// Heat in a rod of n points: x_i' = k (x_(i-1) - 2 x_i + x_(i+1)), ends at 0. A guard at each of
/// the times adds one to the discrete state.
Leaf rod(Index n, double k, const std::vector<double>& times) {
  return Leaf("rod", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [=](const At& at, VectorRef xdot) {
           xdot = -2.0 * k * at.x;
           xdot.head(n - 1) += k * at.x.tail(n - 1);
           xdot.tail(n - 1) += k * at.x.head(n - 1);
         }});
    l.declare_jacobian_sparsity(band_entries(n, 1, 1));
    l.declare_discrete_state(vec({0.0}));
    for (const double time : times)
      l.declare_zero_crossing({.name = text("at_", time),
                               .guard = [=](const At& at) { return at.time - time; },
                               .reset_map = count_up});
  });
}

std::string last_method(const Results& results) { return methods_of(results).back(); }

}  // namespace

TEST_CASE("auto chooses the stiff method by size, tolerance, matrices and events, and says why",
          "[auto]") {
  const auto takes = [](const Results& results, const char* method, const char* why) {
    INFO(results.statistics.method);
    CHECK(last_method(results) == method);
    CHECK(contains(results.statistics.method, why));
  };
  takes(run(rod(16, 1e4, {}), 1.0, Method::automatic), "radau", "few states");
  takes(run(rod(200, 1e4, {}), 1.0, Method::automatic), "bdf", "many states");
  takes(run(rod(200, 1e4, {}), 1.0, Method::automatic, 1e-8, 1e-8), "radau", "tolerance is tight");
  // Events every 0.001 s end the stretches of BDF after a few steps.
  std::vector<double> often;
  for (int i = 1; i < 20; ++i) often.push_back(0.1 + 0.001 * i);
  const auto kicked = run(rod(200, 1e4, often), 1.0, Method::automatic);
  takes(kicked, "radau", "events are frequent");
  CHECK(kicked.context.discrete_state()[0] == 19.0);
  CHECK(kicked.statistics.restarts == 19);
}

TEST_CASE("auto takes BDF where the matrices of Radau are not possible", "[auto]") {
  const Leaf leaf = rod(16, 1e4, {});
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0},
               {.ode_solver_method = Method::automatic, .linear_solver = LinearSolver::gmres});
  CHECK(last_method(results) == "bdf");
  CHECK(contains(results.statistics.method, "would fill up"));
}

TEST_CASE("auto runs again to the same bits after a run that ended in a stiff method", "[auto]") {
  const Index n = GENERATE(16, 200);  // Radau, BDF
  const Leaf leaf = rod(n, 1e4, {0.3, 0.6});
  Simulator simulator(leaf, {.ode_solver_method = Method::automatic});
  std::vector<Eigen::VectorXd> ends;
  std::vector<std::string> words;
  for (int run = 0; run < 2; ++run) {
    simulator.initialize(leaf.create_context());
    simulator.advance_to(1.0);
    ends.push_back(simulator.context().continuous_state());
    words.push_back(simulator.results().statistics.method);
  }
  CHECK(ends[0] == ends[1]);
  CHECK(words[0] == words[1]);
}
