// How far is Saltus from hand-written code? The leaf ball and the ball with drag, e = 0.9, 12 s,
// six bounces: dopri5 against the same method inlined for two states, adams against a plain loop
// over the same CVODE. First line of each group is the floor. Times are medians of interleaved
// batches, ratios are within one run.
#include <cstdio>
#include <cstring>

#include "floor_cvode.hpp"
#include "floor_dopri5.hpp"
#include "interleave.hpp"

namespace {

using bench::Ball, bench::Outcome, bench::SaltusRun;

saltus::SimulatorOptions with(const char* method, double rtol, bool log, int scan) {
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

void print(const char* scene, double rtol, const char* who, const bench::Timing& timing,
           const Outcome& o, double error) {
  std::printf("%-5s %7.0e  %-28s %8.2f us  %5.2f  %7zu %6ld %5ld %7ld  %8.1e\n", scene, rtol, who,
              timing.time * 1e6, timing.ratio, o.bounces, o.steps, o.right_hand_side_calls,
              o.guard_calls, error);
}

/// The event times everyone is compared with: the floor at its tightest.
Outcome reference(const Ball& ball) {
  bench::FloorDopri5 floor(ball, 1e-14, 1e-16);
  floor();
  return floor.outcome();
}

template <class Floor>
void compare(const char* scene, const Ball& ball, const char* method, double rtol,
             const char* floor_name) {
  const Outcome exact = reference(ball);
  Floor floor(ball, rtol, 1e-2 * rtol);
  SaltusRun logged(ball, with(method, rtol, true, 3)), silent(ball, with(method, rtol, false, 3));
  SaltusRun ends_only(ball, with(method, rtol, false, 0));
  const auto timings = bench::interleave(
      {[&] { floor(); }, [&] { logged(); }, [&] { silent(); }, [&] { ends_only(); }});
  // Without a log no bounce is counted: what is left to compare is the end.
  const auto without_log = [&](const SaltusRun& run) {
    Outcome o = run.outcome();
    o.bounces = logged.outcome().bounces, o.times = logged.outcome().times;
    return o;
  };
  print(scene, rtol, floor_name, timings[0], floor.outcome(), worst(floor.outcome(), exact));
  print(scene, rtol, saltus::text("saltus ", method).c_str(), timings[1], logged.outcome(),
        worst(logged.outcome(), exact));
  print(scene, rtol, "  no event log", timings[2], without_log(silent),
        std::abs(silent.outcome().y - logged.outcome().y));
  print(scene, rtol, "  nor a look inside steps", timings[3], without_log(ends_only),
        std::abs(ends_only.outcome().y - logged.outcome().y));
}

/// For a profiler: one runner only, again and again, on the ball with drag; with a third argument
/// on the one without.
int only(const char* who, int runs, bool parabola) {
  const Ball ball{.k = parabola ? 0.0 : 9.81 / 400.0};
  bench::FloorDopri5 dopri5(ball, 1e-8, 1e-10);
  bench::FloorCvode cvode(ball, 1e-8, 1e-10);
  SaltusRun saltus_dopri5(ball, with("dopri5", 1e-8, true, 3)),
      saltus_dop853(ball, with("dop853", 1e-8, true, 3)),
      saltus_adams(ball, with("adams", 1e-8, true, 3));
  for (int i = 0; i < runs; ++i) {
    if (std::strcmp(who, "floor_dopri5") == 0)
      dopri5();
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
  std::printf(
      "SUNDIALS %s. Errors are those of the worst event time [s]; without a log, the difference in "
      "y at the end [m].\n",
      SUNDIALS_VERSION);
  std::printf(
      "scene    rtol  who                              time  ratio  bounces  steps   rhs  guards   "
      "  error\n");
  const Ball parabola, drag{.k = 9.81 / 400.0};  // terminal velocity 20 m/s
  for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (const auto& [name, ball] : {std::pair("ball", parabola), std::pair("drag", drag)}) {
      compare<bench::FloorDopri5>(name, ball, "dopri5", rtol, "inlined DP5");
      compare<bench::FloorCvode>(name, ball, "adams", rtol, "plain CVODE loop");
    }
  }
}
