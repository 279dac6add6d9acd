// How far is BDF from a hand-written loop over the same CVODE? Small stiff problems with the same
// Jacobian, and the 1-D Brusselator with SUNDIALS's band matrix; N is the number of cells, two
// states each. Ratios within one run, medians of interleaved batches.
#include <cstring>

#include "interleave.hpp"
#include "peer_sundials.hpp"
#include "sheet.hpp"

namespace {

using bench::CvodePeer, bench::StiffLeaf, bench::StiffProblem;

/// A plain CVODE loop that is asked for the end only; its error is not looked at.
CvodePeer plain_loop(const StiffProblem& problem, double rtol, double atol) {
  return {{problem.name, problem, {{problem.t_end, problem.start}}, atol / rtol}, rtol};
}

class Ours {
 public:
  Ours(const StiffProblem& problem, double rtol, double atol)
      : leaf_(problem),
        start_(leaf_.create_context()),
        t_end_(problem.t_end),
        simulator_(leaf_, {.rtol = rtol, .atol = atol, .ode_solver_method = saltus::Method::bdf}) {}
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

bench::Timing compare(bench::Sheet& sheet, const StiffProblem& problem, double rtol, double atol) {
  CvodePeer floor = plain_loop(problem, rtol, atol);
  Ours ours(problem, rtol, atol);
  const auto times = bench::interleave({[&] { floor.run(); }, [&] { ours(); }}, 31, 3e-3);
  const auto& s = ours.results().statistics;
  const double apart =
      (ours.results().context.continuous_state() - floor.rows()[0]).cwiseAbs().maxCoeff();
  sheet.add({{"problem", problem.name},
             {"states", problem.start.size()},
             {"rtol", rtol},
             {"floor [ms]", times[0].time * 1e3},
             {"ours [ms]", times[1].time * 1e3},
             {"ratio", times[1].ratio},
             {"steps of floor", floor.counts().steps},
             {"our steps", s.steps},
             {"rhs of floor", floor.counts().calls},
             {"our rhs", s.right_hand_side_calls},
             {"apart", apart}});
  return times[1];
}

/// For a profiler: runs only one runner, repeatedly.
int only(const char* who, const StiffProblem& problem, int runs) {
  CvodePeer floor = plain_loop(problem, 1e-6, 1e-8);
  Ours ours(problem, 1e-6, 1e-8);
  for (int i = 0; i < runs; ++i) std::strcmp(who, "floor") == 0 ? void(floor.run()) : ours();
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
  bench::Sheet sheet("stiff_floor",
                     "How far is BDF from a plain CVODE loop, and how does it grow?");
  for (const auto& [problem, scale] : {std::pair(bench::van_der_pol(), 1e-2),
                                       {bench::robertson(), 1e-4},
                                       {bench::hires(), 1e-2}}) {
    double most = 0.0;
    for (const double rtol : {1e-4, 1e-6, 1e-8})
      most = std::max(most, compare(sheet, problem, rtol, scale * rtol).ratio);
    sheet.target(saltus::text(problem.name, ", worst of three tolerances: bdf against CVODE"), most,
                 1.05);
  }
  double before = 0.0, most = 0.0, growth = 0.0;
  for (const long cells : {10L, 100L, 1000L, 10'000L}) {
    const auto [time, ratio] = compare(sheet, bench::brusselator(cells), 1e-6, 1e-8);
    most = std::max(most, ratio);
    if (before > 0.0) growth = std::max(growth, std::log10(time / before));
    before = time;
  }
  sheet.target("Brusselator, 10 to 10 000 cells: bdf against CVODE with a band matrix", most, 1.15);
  sheet.target("Brusselator: exponent of N in our time, from ten times fewer cells", growth, 1.1);
}
