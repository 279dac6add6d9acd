// How far is BDF from a hand-written loop over the same CVODE? Small stiff problems with the same
// Jacobian, and the 1-D Brusselator with SUNDIALS's band matrix; N is the number of cells, two
// states each. Ratios within one run, medians of interleaved batches. The last column is the
// exponent of N in our time from the line above.
#include <cstdio>
#include <cstring>

#include "interleave.hpp"
#include "stiff_problems.hpp"

namespace {

using bench::FloorStiff, bench::StiffLeaf, bench::StiffProblem;

class Ours {
 public:
  Ours(const StiffProblem& problem, double rtol, double atol)
      : leaf_(problem),
        start_(leaf_.create_context()),
        t_end_(problem.t_end),
        simulator_(leaf_, {.rtol = rtol, .atol = atol, .ode_solver_method = "bdf"}) {}
  void operator()() {
    simulator_.initialize(start_);
    simulator_.advance_to(t_end_);
  }
  const saltus::Results& results() const { return simulator_.results(); }

 private:
  StiffLeaf leaf_;
  saltus::Context start_;
  double t_end_;
  saltus::Simulator simulator_;
};

/// Returns our time [s].
double compare(const StiffProblem& problem, double rtol, double atol, double before, double size) {
  FloorStiff floor(problem, rtol, atol);
  Ours ours(problem, rtol, atol);
  const auto times = bench::interleave({[&] { floor(); }, [&] { ours(); }}, 31, 3e-3);
  const auto& s = ours.results().statistics;
  const double apart =
      (ours.results().context.continuous_state() - floor.state()).cwiseAbs().maxCoeff();
  std::printf("%-12s %6td %7.0e  %10.3f ms  %10.3f ms  %5.3f  %6ld %6ld  %7ld %7ld  %8.1e",
              problem.name, static_cast<std::ptrdiff_t>(problem.start.size()), rtol,
              times[0].time * 1e3, times[1].time * 1e3, times[1].ratio, floor.steps(),
              static_cast<long>(s.steps), floor.calls(), static_cast<long>(s.right_hand_side_calls),
              apart);
  if (before > 0.0) std::printf("  %5.2f", std::log(times[1].time / before) / std::log(size));
  std::printf("\n");
  return times[1].time;
}

/// For a profiler: one runner only, again and again.
int only(const char* who, const StiffProblem& problem, int runs) {
  FloorStiff floor(problem, 1e-6, 1e-8);
  Ours ours(problem, 1e-6, 1e-8);
  for (int i = 0; i < runs; ++i) std::strcmp(who, "floor") == 0 ? floor() : ours();
  if (std::strcmp(who, "floor") != 0) std::puts(ours.results().statistics.linear_solver.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4) {
    const std::string name = argv[2];
    return only(argv[1],
                name == "vdpol"       ? bench::van_der_pol()
                : name == "robertson" ? bench::robertson()
                : name == "hires"     ? bench::hires()
                                      : bench::brusselator(std::atol(argv[2])),
                std::atoi(argv[3]));
  }
  std::printf("SUNDIALS %s\n", SUNDIALS_VERSION);
  std::printf(
      "problem      states    rtol    floor          ours           ratio     steps      "
      "    rhs           apart     growth\n");
  for (const double rtol : {1e-4, 1e-6, 1e-8}) {
    compare(bench::van_der_pol(), rtol, 1e-2 * rtol, 0.0, 0.0);
    compare(bench::robertson(), rtol, 1e-4 * rtol, 0.0, 0.0);
    compare(bench::hires(), rtol, 1e-2 * rtol, 0.0, 0.0);
  }
  double before = 0.0;
  for (const long cells : {10L, 100L, 1000L, 10'000L})
    before = compare(bench::brusselator(cells), 1e-6, 1e-8, before, 10.0);
}
