// TransportDelay: closed forms behind a delay, exact times of jumps, loops, resumed runs.
#include <cmath>

#include "library_runs.hpp"
#include "saltus/library/detail/past.hpp"
#include "saltus/model/context_json.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

/// A source, and a delay behind it.
template <class Source, class... Arguments>
Diagram delayed(double delay, const TransportDelay::Options& options, Arguments&&... arguments) {
  DiagramBuilder builder;
  auto& source = builder.add<Source>("source", std::forward<Arguments>(arguments)...);
  auto& block = builder.add<TransportDelay>("delay", delay, options);
  builder.connect(source.output(), block.input());
  return builder.build();
}

/// x' = -x(t - 1), x = 1 before and at 0.
Diagram loop() {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 1.0});
  auto& block = builder.add<TransportDelay>("delay", 1.0, TransportDelay::Options{1.0});
  auto& minus = builder.add<Gain>("minus", -1.0);
  builder.connect(x.output(), block.input());
  builder.connect(block.output(), minus.input());
  builder.connect(minus.output(), x.input());
  return builder.build();
}

/// The method of steps by hand: x(t) = sum over k of (-1)^k (t - k + 1)^k / k!, for k = 0 and all k
/// with t > k - 1. (O. Diekmann et al., "Delay Equations", 1995, ch. I.)
double method_of_steps(double t) {
  double x = 1.0, factorial = 1.0;
  for (int k = 1; t > k - 1; ++k) {
    factorial *= k;
    x += (k % 2 == 0 ? 1.0 : -1.0) * std::pow(t - k + 1, k) / factorial;
  }
  return x;
}

Numbers grid(double end, int n) {
  Numbers times;
  for (int i = 1; i <= n; ++i) times.push_back(end * i / n);
  return times;
}

}  // namespace

TEST_CASE("which steps begin with a break of a past", "[library][transport_delay]") {
  using detail::break_level;
  // the signal jumped, the level that the delay itself made, it has a kink; the level of the break
  CHECK(break_level(false, 0, false) == 0);
  CHECK(break_level(false, 3, false) == 3);
  CHECK(break_level(false, detail::last_break_level, false) == detail::last_break_level);
  CHECK(break_level(false, detail::last_break_level + 1, false) == -1);
  CHECK(break_level(true, detail::last_break_level + 1, false) == 0);
  CHECK(break_level(false, detail::last_break_level + 1, true) == detail::last_break_level);
}

TEST_CASE("whole numbers that are read from a past", "[library][transport_delay]") {
  using detail::whole;
  constexpr double inf = std::numeric_limits<double>::infinity();
  struct Row {
    double number;
    Index least, most, expected;
  };
  for (const Row& row :
       {Row{0.0, 0, 9, 0}, Row{3.0, 0, 9, 3}, Row{9.0, 0, 9, 9}, Row{2.9, 0, 9, 2},
        Row{-1.0, -1, 4, -1}, Row{-0.5, -1, 4, 0}, Row{-7.0, 0, 9, 0}, Row{10.0, 0, 9, 9},
        Row{1e308, 0, 9, 9}, Row{0x1p63, -1, 4, 4}, Row{-0x1p63, -1, 4, -1}, Row{inf, 0, 9, 9},
        Row{-inf, 0, 9, 0}, Row{std::nan(""), -1, 4, -1}, Row{5.0, 0, 0, 0}}) {
    CAPTURE(row.number, row.least, row.most);
    CHECK(whole(row.number, row.least, row.most) == row.expected);
  }
}

/// A user may write anything to the state of a delay. A run from there goes on or ends in an error.
TEST_CASE("no number in a past leads out of it", "[library][transport_delay]") {
  const Diagram diagram = loop();
  const Context before = simulate(diagram, diagram.create_context(), {0.0, 2.5}, {}).context;
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Index first_piece = 4;  // three numbers of a piece follow the four of the head
  for (Index entry = 0; entry < first_piece + 3; ++entry) {
    for (const double forged : {std::nan(""), inf, -inf, 1e308, -1e308, 0x1p63, -0x1p63, 0x1p31,
                                -1.0, 0.5, 1.0, 7.0, 1e6}) {
      Eigen::VectorXd z = before.discrete_state();  // the delay's alone: no other block has one
      z[entry] = forged;
      CAPTURE(entry, forged);
      try {
        const auto results =
            simulate(diagram, before.with_discrete_state(z), {2.5, 2.6}, {.max_major_steps = 100});
        CHECK(results.context.time() >= 2.5);
      } catch (const ModelError&) {       // the state is refused
      } catch (const SimulationError&) {  // the past has no input up to here
      }
    }
  }
}

/// A line is its own polynomial: only rounding is left. Its kink at 1 s is one at 1.3 s.
TEST_CASE("a delayed ramp is the ramp, later", "[library][transport_delay]") {
  const Diagram diagram = delayed<Ramp>(0.3, {-1.0}, Ramp::Options{.slope = 2.0});
  const Numbers times = grid(3.0, 61);
  const Numbers y = at_times(diagram, diagram["delay"].output(), times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    const double exact = t < 0.3 ? -1.0 : 2.0 * std::max(0.0, t - 1.3);
    CHECK_THAT(y[i], WithinAbs(exact, rounding));
  }
}

/// No state sets a step, so the delay alone follows the sine. Its error is at most the tolerance at
/// each, over seven decades of it.
TEST_CASE("a delayed sine is within the tolerance", "[library][transport_delay]") {
  const Diagram diagram = delayed<Sine>(2.0, {.capacity = 1000}, Sine::Options{.frequency = 20.0});
  const Numbers times = grid(6.0, 997);
  for (const double tolerance : {1e-4, 1e-7, 1e-11}) {
    const SimulatorOptions options{.rtol = tolerance, .atol = tolerance};
    const Numbers y = at_times(diagram, diagram["delay"].output(), times, 0, options);
    double worst = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double exact = times[i] < 2.0 ? 0.0 : std::sin(20.0 * (times[i] - 2.0));
      worst = std::max(worst, std::abs(y[i] - exact));
    }
    CHECK(worst < tolerance);
  }
}

/// A pulse of period 1 s and width 1/4 jumps at k and k + 1/4. Behind the delay each jump is a time
/// event with a row before and one after it; the sum of two times is rounded once, by eps |t| / 2.
TEST_CASE("each jump comes again at its exact time", "[library][transport_delay]") {
  const double delay = 0.7;
  const Diagram diagram = delayed<Pulse>(
      delay, {5.0}, Pulse::Options{.amplitude = 3.0, .period = 1.0, .pulse_width = 0.25});
  SimulatorOptions options = precise();
  options.recorded_signals = {{"y", diagram["delay"].output()}};
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 4.0}, options);
  const auto y = results.output("y");
  Numbers jumps;
  for (std::size_t i = 1; i < results.time.size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (y(row, 0) == y(row - 1, 0)) continue;
    CHECK(results.time[i] == results.time[i - 1]);
    jumps.push_back(results.time[i]);
  }
  const Numbers expected{0.7, 0.95, 1.7, 1.95, 2.7, 2.95, 3.7, 3.95};
  REQUIRE(jumps.size() == expected.size());
  for (std::size_t i = 0; i < jumps.size(); ++i)
    CHECK_THAT(jumps[i], WithinAbs(expected[i], 4.0 * 2.2e-16));
}

/// The integral of a delayed pulse has kinks at the jumps, so a jump that a step passed would show.
TEST_CASE("a solver stops at delayed jumps", "[library][transport_delay]") {
  DiagramBuilder builder;
  auto& pulse = builder.add<Pulse>("pulse", Pulse::Options{.period = 1.0, .pulse_width = 0.25});
  auto& block = builder.add<TransportDelay>("delay", 0.7);
  auto& x = builder.add<Integrator>("x");
  builder.connect(pulse.output(), block.input());
  builder.connect(block.output(), x.input());
  const Diagram diagram = builder.build();
  const Numbers x_at = at_times(diagram, diagram["x"].output(), {0.7, 0.8, 1.0, 1.8, 3.0});
  const Numbers exact{0.0, 0.1, 0.25, 0.35, 0.75};
  for (std::size_t i = 0; i < exact.size(); ++i) CHECK_THAT(x_at[i], WithinAbs(exact[i], rounding));
}

/// Global errors of x' = -x(t - 1): at each break the solver starts again, so with tolerance tol it
/// is some 10 tol per second, as in library_runs.hpp.
TEST_CASE("a delay in a loop follows the method of steps", "[library][transport_delay]") {
  const Diagram diagram = loop();
  const Numbers times = grid(5.0, 100);
  for (const std::string method : {"dopri5", "dop853", "bdf", "radau"}) {
    CAPTURE(method);
    SimulatorOptions options = precise();
    options.ode_solver_method = method_from(method);
    const double tolerance = method == "bdf" ? 1e3 * options.rtol : solver_tolerance;
    const Numbers x = at_times(diagram, diagram["x"].output(), times, 0, options);
    for (std::size_t i = 0; i < times.size(); ++i)
      CHECK_THAT(x[i], WithinAbs(method_of_steps(times[i]), tolerance));
  }
}

/// sin(t) passes zero at k pi. A truth that only a delay reads is located as if a derivative read it:
/// within 100 eps of a step and the rounding of the sum.
TEST_CASE("a truth that only a delay reads is located", "[library][transport_delay]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& above = builder.add<Comparator>("above", ">");
  auto& block = builder.add<TransportDelay>("delay", 0.5);
  builder.connect(sine.output(), above.input(0));
  builder.connect(zero.output(), above.input(1));
  builder.connect(above.output(), block.input());
  const Diagram diagram = builder.build();
  SimulatorOptions options = precise();
  options.recorded_signals = {{"y", diagram["delay"].output()}};
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 7.0}, options);
  const auto y = results.output("y");
  Numbers jumps;
  for (std::size_t i = 1; i < results.time.size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (y(row, 0) != y(row - 1, 0)) jumps.push_back(results.time[i]);
  }
  const double pi = std::acos(-1.0);
  const Numbers expected{0.5, pi + 0.5, 2.0 * pi + 0.5};
  REQUIRE(jumps.size() == expected.size());
  for (std::size_t i = 0; i < jumps.size(); ++i)
    CHECK_THAT(jumps[i], WithinAbs(expected[i], 1e-12));
}

TEST_CASE("delays in a row add up", "[library][transport_delay]") {
  DiagramBuilder builder;
  auto& step = builder.add<Step>("step", Step::Options{.step_time = 0.25});
  auto& ramp = builder.add<Integrator>("ramp");
  auto& a = builder.add<TransportDelay>("a", 0.5);
  auto& b = builder.add<TransportDelay>("b", 0.125);
  builder.connect(step.output(), ramp.input());
  builder.connect(ramp.output(), a.input());
  builder.connect(a.output(), b.input());
  const Diagram diagram = builder.build();
  const Numbers times = grid(2.0, 64);
  const Numbers y = at_times(diagram, diagram["b"].output(), times);
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(y[i], WithinAbs(std::max(0.0, times[i] - 0.875), rounding));
}

/// The jump of a step passes both at once, each entry of a vector with the others.
TEST_CASE("a vector is delayed as a whole", "[library][transport_delay]") {
  const Diagram diagram =
      delayed<Step>(0.5, {.initial_output = Value{7.0, 8.0}},
                    Step::Options{.start_value = Value{1.0, 2.0}, .end_value = Value{3.0, 4.0}});
  for (const Index entry : {0, 1}) {
    const double up = static_cast<double>(entry);
    CHECK(at_times(diagram, diagram["delay"].output(), {0.25, 0.5, 1.25, 1.5, 2.0}, entry) ==
          Numbers{7.0 + up, 1.0 + up, 1.0 + up, 3.0 + up, 3.0 + up});
  }
}

/// The past is in the context. A run that goes on from a saved context has the bits of one that
/// goes on from the context itself, and the solution of the whole run.
TEST_CASE("a resumed run has the past of the first one", "[library][transport_delay]") {
  const Diagram diagram = loop();
  const auto first = simulate(diagram, diagram.create_context(), {0.0, 2.6}, precise());
  const Context saved = context_from_json(diagram, to_json(first.context));
  const auto a = simulate(diagram, first.context, {2.6, 5.0}, precise());
  const auto b = simulate(diagram, saved, {2.6, 5.0}, precise());
  CHECK(a.context.continuous_state() == b.context.continuous_state());
  CHECK(a.context.discrete_state() == b.context.discrete_state());
  CHECK_THAT(a.context.continuous_state()[0], WithinAbs(method_of_steps(5.0), solver_tolerance));
}

/// Dense output reads the past as it was in each step.
TEST_CASE("dense output shows the delayed signal", "[library][transport_delay]") {
  const Diagram diagram = loop();
  SimulatorOptions options = precise();
  options.dense_output = true;
  options.recorded_signals = {{"y", diagram["delay"].output()}};
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 5.0}, options);
  for (const double t : grid(4.99, 77)) {
    const double exact = t < 1.0 ? 1.0 : method_of_steps(t - 1.0);
    CHECK_THAT(results.at(t).output("y")[0], WithinAbs(exact, solver_tolerance));
  }
}

TEST_CASE("a past that has no room says so", "[library][transport_delay][errors]") {
  const Diagram diagram = delayed<Sine>(1.0, {.capacity = 4}, Sine::Options{.frequency = 500.0});
  try {
    simulate(diagram, diagram.create_context(), {0.0, 2.0}, precise());
    FAIL("no error");
  } catch (const SimulationError& error) {
    CHECK(contains(error.what(), "'delay' keeps 4 pieces"));
    CHECK(contains(error.what(), "Raise its capacity"));
  }
}

/// 400 rad in pieces of about 1 rad: some four hundred pieces go through a state for sixty.
TEST_CASE("a long run needs room for the delay only", "[library][transport_delay]") {
  const Diagram diagram = delayed<Sine>(0.5, {.capacity = 60}, Sine::Options{.frequency = 20.0});
  const Numbers times = grid(20.0, 997);
  const Numbers y =
      at_times(diagram, diagram["delay"].output(), times, 0, {.rtol = 1e-7, .atol = 1e-7});
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(y[i], WithinAbs(times[i] < 0.5 ? 0.0 : std::sin(20.0 * (times[i] - 0.5)), 1e-7));
}

TEST_CASE("a past with a gap is refused", "[library][transport_delay][errors]") {
  const Diagram diagram = loop();
  const auto first = simulate(diagram, diagram.create_context(), {0.0, 2.0}, precise());
  try {
    simulate(diagram, first.context.with_time(3.0), {3.0, 4.0}, precise());
    FAIL("no error");
  } catch (const SimulationError& error) {
    CHECK(contains(error.what(), "the past of block 'delay' ends at t = 2 s"));
  }
}

/// Whatever a user writes into the state, no number of it leads out of the state.
TEST_CASE("a past of any numbers stays within its state", "[library][transport_delay]") {
  for (const double bad : {-3.0, 1e300, 17.5}) {
    Eigen::VectorXd z = Eigen::VectorXd::Constant(detail::Past::size(1, 4), bad);
    const detail::Past past(VectorView(z.data(), z.size()), 1);
    CHECK(past.pieces() >= 0);
    CHECK(past.pieces() <= 4);
    double u = 0.0;
    if (!past.none_open()) past.value(1.0, VectorRef(&u, 1));
    past.next_break();
  }
}

TEST_CASE("a history needs an input, a function and a step", "[library][transport_delay][errors]") {
  struct Keeper : LeafSystem {
    explicit Keeper(const History& history) : LeafSystem("keeper") {
      declare_input_port();
      declare_history(history);
    }
  };
  const auto nothing = [](const AcceptedStep&, VectorRef) {};
  for (const History& bad :
       {History{1, nothing, 1.0}, History{0, {}, 1.0}, History{0, nothing, 0.0}})
    CHECK(contains(model_error([&] { Keeper{bad}; }), "block 'keeper': a history of input"));
}

TEST_CASE("delays that are no delay are refused", "[library][transport_delay][errors]") {
  CHECK(contains(model_error([] { TransportDelay("d", 0.0); }), "delay"));
  CHECK(contains(model_error([] { TransportDelay("d", 1.0, {.capacity = 3}); }),
                 "expected 4 pieces of capacity or more"));
}

/// A break that falls together with a tick, and comes back at one, takes the time of the tick. So its
/// time carries no roundings from one delay to the next, and the two remain one instant.
TEST_CASE("a sampled signal is late by the same number of ticks for ever",
          "[library][transport_delay]") {
  const auto& [dt, ticks] = GENERATE(std::pair{0.1, 1}, std::pair{1.0 / 3.0, 1}, std::pair{0.3, 1},
                                     std::pair{0.7, 1}, std::pair{0.1, 3});
  DiagramBuilder builder;
  auto& clock = builder.add<DiscreteClock>("clock", dt);
  auto& block = builder.add<TransportDelay>("delay", ticks * dt);
  auto& hold = builder.add<ZeroOrderHold>("hold", dt);
  builder.connect(clock.output(), block.input());
  builder.connect(block.output(), hold.input());
  const Diagram diagram = builder.build();
  Numbers times;
  for (int k = 0; k < 1000; ++k) times.push_back((k + 0.5) * dt);
  const Numbers y = at_times(diagram, diagram["hold"].output(), times);
  INFO("period " << dt << ", delay of " << ticks);
  const double late = std::round(19.0 - y[19] / dt);
  int others = 0;
  for (int k = 20; k < 1000; ++k)
    others += std::abs(y[static_cast<std::size_t>(k)] - (k - late) * dt) > 1e-9;
  CHECK(others == 0);
}

/// v(t) = a v(t - tau) + |sin 3t|, x' = v: x is the sum of a^k F(t - k tau), where F is the integral
/// of |sin 3t|. Nothing in the loop makes the kinks smoother. Ten tolerances for each turn.
TEST_CASE("a loop of a delay without an integrator keeps its kinks", "[library][transport_delay]") {
  constexpr double a = 0.9, tau = 0.7, end = 12.0;
  const double pi = std::acos(-1.0);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", Sine::Options{.frequency = 3.0});
  auto& size = builder.add<Abs>("abs");
  auto& sum = builder.add<Adder>("sum");
  auto& block = builder.add<TransportDelay>("delay", tau, TransportDelay::Options{0.0, 2000});
  auto& gain = builder.add<Gain>("gain", a);
  auto& x = builder.add<Integrator>("x");
  builder.connect(sine.output(), size.input());
  builder.connect(size.output(), sum.input(0));
  builder.connect(gain.output(), sum.input(1));
  builder.connect(sum.output(), block.input());
  builder.connect(block.output(), gain.input());
  builder.connect(sum.output(), x.input());
  const Diagram diagram = builder.build();
  const auto integral = [&](double t) {
    if (t <= 0.0) return 0.0;
    const double turns = std::floor(3.0 * t / pi);
    return (2.0 * turns + 1.0 - std::cos(3.0 * t - turns * pi)) / 3.0;
  };
  double exact = 0.0;
  for (int k = 0; k * tau < end; ++k) exact += std::pow(a, k) * integral(end - k * tau);
  for (const double rtol : {1e-6, 1e-8}) {
    const Numbers found =
        at_times(diagram, diagram["x"].output(), {end}, 0, {.rtol = rtol, .atol = 0.01 * rtol});
    INFO("rtol " << rtol);
    CHECK_THAT(found.back(), WithinAbs(exact, 10.0 * rtol * exact * (end / tau)));
  }
}

/// At t = 1e9 a double is a multiple of 1.2e-7: the values of a signal are as uncertain as it is
/// steep there, and no shorter piece shows it better.
TEST_CASE("a delay runs at a late time", "[library][transport_delay]") {
  const Diagram diagram = loop();
  const auto [begin, rtol] = GENERATE(std::pair{1e6, 1e-9}, std::pair{1e9, 1e-6});
  const auto results = simulate(diagram, diagram.create_context(begin), {begin, begin + 3.0},
                                {.rtol = rtol, .atol = 0.01 * rtol});
  // Ten tolerances; and |x'| <= 1, so each second's end is moved by a few roundings of the time.
  const double allowed = 10.0 * rtol + 20.0 * 2.2e-16 * begin;
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(method_of_steps(3.0), allowed));
}
