// How far is Saltus from hand-written code? The leaf ball and the ball with drag, e = 0.9, 12 s,
// six bounces. The right-hand side is inlined (`saltus::inlined`), in one line of the table called:
// dopri5 and dop853 against the same methods inlined for two states, adams against a plain loop
// over the same CVODE. Errors are those of the worst event time [s]; without a log, the difference
// in y at the end [m]. First line of each group is the floor. Times are medians of interleaved
// batches, ratios are within one run.
#include <cstring>

#include "floor_cvode.hpp"
#include "floor_one_step.hpp"
#include "interleave.hpp"
#include "sheet.hpp"

namespace {

using bench::Ball, bench::Outcome, bench::SaltusRun;

saltus::SimulatorOptions with(saltus::Method method, double rtol, bool log, int scan) {
  return {.rtol = rtol,
          .atol = 1e-2 * rtol,
          .ode_solver_method = method,
          .event_scan_points = scan,
          .record_events = log};
}

double worst(const Outcome& a, const Outcome& b) {
  if (a.bounces != b.bounces) return std::numeric_limits<double>::infinity();
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(a.bounces, a.times.size()); ++i)
    worst = std::max(worst, std::abs(a.times[i] - b.times[i]));
  return worst;
}

bench::Row row(const char* scene, double rtol, const std::string& who, const bench::Timing& timing,
               const Outcome& o, double error) {
  return {{"scene", scene},
          {"rtol", rtol},
          {"who", who},
          {"time [us]", timing.time * 1e6},
          {"ratio", timing.ratio},
          {"bounces", o.bounces},
          {"steps", o.steps},
          {"rhs", o.right_hand_side_calls},
          {"guards", o.guard_calls},
          {"error", error}};
}

/// The reference of the event times: the floor at its tightest tolerance.
Outcome reference(const Ball& ball) {
  bench::FloorDop853 floor(ball, 1e-14, 1e-16);
  floor();
  return floor.outcome();
}

/// Returns the ratio with the event log on, as it is by default.
template <class Floor>
double compare(bench::Sheet& sheet, const char* scene, const Ball& ball, saltus::Method method,
               double rtol, const char* floor_name) {
  const Outcome exact = reference(ball);
  Floor floor(ball, rtol, 1e-2 * rtol);
  SaltusRun logged(ball, with(method, rtol, true, 3)), silent(ball, with(method, rtol, false, 3));
  SaltusRun ends_only(ball, with(method, rtol, false, 0)),
      called(ball, with(method, rtol, true, 3), false);
  const auto timings = bench::interleave({[&] { floor(); }, [&] { logged(); }, [&] { silent(); },
                                          [&] { ends_only(); }, [&] { called(); }});
  // Without a log no bounce is counted, so only the end can be compared.
  const auto without_log = [&](const SaltusRun& run) {
    Outcome o = run.outcome();
    o.bounces = logged.outcome().bounces, o.times = logged.outcome().times;
    return o;
  };
  const auto add = [&](const std::string& who, std::size_t i, const Outcome& o, double error) {
    sheet.add(row(scene, rtol, who, timings[i], o, error));
  };
  add(floor_name, 0, floor.outcome(), worst(floor.outcome(), exact));
  add(saltus::text("saltus ", to_string(method)), 1, logged.outcome(),
      worst(logged.outcome(), exact));
  add("  no event log", 2, without_log(silent), std::abs(silent.outcome().y - logged.outcome().y));
  add("  nor a look inside steps", 3, without_log(ends_only),
      std::abs(ends_only.outcome().y - logged.outcome().y));
  add("  right-hand side called", 4, called.outcome(), worst(called.outcome(), exact));
  return timings[1].ratio;
}

/// Runs only one runner, repeatedly, for a profiler: on the ball with drag, or with a third
/// argument on the ball without drag.
int only(const char* who, int runs, bool parabola) {
  const Ball ball{.k = parabola ? 0.0 : 9.81 / 400.0};
  bench::FloorDopri5 dopri5(ball, 1e-8, 1e-10);
  bench::FloorDop853 dop853(ball, 1e-8, 1e-10);
  bench::FloorCvode cvode(ball, 1e-8, 1e-10);
  SaltusRun saltus_dopri5(ball, with(saltus::Method::dopri5, 1e-8, true, 3)),
      saltus_dop853(ball, with(saltus::Method::dop853, 1e-8, true, 3)),
      saltus_adams(ball, with(saltus::Method::adams, 1e-8, true, 3));
  for (int i = 0; i < runs; ++i) {
    if (std::strcmp(who, "floor_dopri5") == 0)
      dopri5();
    else if (std::strcmp(who, "floor_dop853") == 0)
      dop853();
    else if (std::strcmp(who, "floor_cvode") == 0)
      cvode();
    else if (std::strcmp(who, "dopri5") == 0)
      saltus_dopri5();
    else if (std::strcmp(who, "dop853") == 0)
      saltus_dop853();
    else if (std::strcmp(who, "adams") == 0)
      saltus_adams();
    else
      return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2) return only(argv[1], std::atoi(argv[2]), argc > 3);
  bench::Sheet sheet("ball_floor", "How far is Saltus from hand-written code?");
  const Ball parabola, drag{.k = 9.81 / 400.0};  // terminal velocity 20 m/s
  for (const auto& [name, ball] : {std::pair("ball", parabola), std::pair("drag", drag)}) {
    std::array<double, 3> most{};
    for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      const std::array now{compare<bench::FloorDopri5>(sheet, name, ball, saltus::Method::dopri5,
                                                       rtol, "inlined DOPRI5"),
                           compare<bench::FloorDop853>(sheet, name, ball, saltus::Method::dop853,
                                                       rtol, "inlined DOP853"),
                           compare<bench::FloorCvode>(sheet, name, ball, saltus::Method::adams,
                                                      rtol, "plain CVODE loop")};
      for (std::size_t i = 0; i < now.size(); ++i) most[i] = std::max(most[i], now[i]);
    }
    const std::string worst = saltus::text(name, ", worst of five tolerances: ");
    sheet.target(worst + "dopri5 against inlined DOPRI5", most[0], 1.5);
    sheet.target(worst + "dop853 against inlined DOP853", most[1], 1.5);
    sheet.target(worst + "adams against a plain CVODE loop", most[2], 1.1);
  }
}
