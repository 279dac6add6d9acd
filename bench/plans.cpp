// How does the cost of a plan grow? Diagrams of 1 000 to 100 000 blocks, deep (a chain of lags) and
// wide (lags side by side that read one source): the processor time of the diagram, of its plan and
// of a simulator. An exponent of 1 is linear. `plans deep 10000` makes one plan, for a profiler.
#include <cmath>
#include <cstring>
#include <saltus/library/library.hpp>
#include <saltus/plan/compile.hpp>
#include <saltus/saltus.hpp>

#include "interleave.hpp"
#include "sheet.hpp"

namespace {

using namespace saltus;

/// Lags x' = 2 (u - x), three blocks each: one after the other, or side by side.
Diagram lags(Index n, bool deep) {
  DiagramBuilder builder;
  const OutputPort source = builder.add<Sine>("sine", Sine::Options{}).output();
  OutputPort before = source;
  for (Index i = 0; i < n; ++i) {
    auto& difference = builder.add<Adder>(text("difference_", i), "+-");
    auto& rate = builder.add<Gain>(text("rate_", i), 2.0);
    auto& lag = builder.add<Integrator>(text("lag_", i), Integrator::Options{});
    builder.connect(deep ? before : source, difference.input(0));
    builder.connect(lag.output(), difference.input(1));
    builder.connect(difference.output(), rate.input());
    builder.connect(rate.output(), lag.input());
    before = lag.output();
  }
  return builder.build("lags");
}

/// [s] The best of some rounds.
double least(int rounds, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rounds; ++i) best = std::min(best, bench::seconds(work));
  return best;
}

void grow(bench::Sheet& sheet, const char* form, bool deep) {
  double before = 0.0, exponent = 0.0;
  for (const Index blocks : {1'000, 3'162, 10'000, 31'623, 100'000}) {
    const int rounds = blocks > 20'000 ? 3 : 7;
    std::unique_ptr<Diagram> made;
    const double diagram =
        least(rounds, [&] { made = std::make_unique<Diagram>(lags(blocks / 3, deep)); });
    const double plan = least(rounds, [&] { compile(*made); });
    const double simulator =
        least(rounds, [&] { Simulator(*made, {.ode_solver_method = Method::dopri5}); });
    exponent = before > 0.0 ? std::log(plan / before) / std::log(std::sqrt(10.0)) : 0.0;
    before = plan;
    sheet.add({{"form", form},
               {"blocks", blocks},
               {"diagram [ms]", diagram * 1e3},
               {"plan [ms]", plan * 1e3},
               {"simulator [ms]", simulator * 1e3},
               {"plan / block [us]", plan / static_cast<double>(blocks) * 1e6},
               {"exponent", exponent}});
  }
  sheet.target(text(form, ": exponent from 31 623 to 100 000 blocks"), exponent, 1.1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3) {
    const Diagram diagram = lags(std::atol(argv[2]) / 3, std::strcmp(argv[1], "deep") == 0);
    compile(diagram);
    return 0;
  }
  bench::Sheet sheet("plans", "How does the cost of a plan grow, up to 100 000 blocks?");
  grow(sheet, "deep", true);
  grow(sheet, "wide", false);
}
