// How does the cost grow with the number of guards? n guards that fire once each: monitors as one
// vector, monitors as single guards, single guards with reset maps, and guards with reset maps in a
// block each. dopri5 at rtol 1e-6. The exponent is that of the growth of the time from half as
// many guards: 1 is linear, 2 is square. `many_guards reset 500 3` makes three runs of one form
// (vector, single, reset, blocks), for a profiler.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <saltus/saltus.hpp>
#include <string_view>

#include "sheet.hpp"

namespace {

using namespace saltus;

enum class Form { vector, single, reset, blocks };

/// x' = 1 from 0 to 1; guard i fires at x = (i + 1/2) / n.
class Ruler final : public LeafSystem {
 public:
  Ruler(Index n, Form form) : LeafSystem("ruler") {
    declare_continuous_state(
        {.initial = Eigen::VectorXd::Zero(1), .ode = [](const At&) { return 1.0; }});
    if (form == Form::vector) {
      const Eigen::VectorXd levels =
          (Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)).array() + 0.5) /
          static_cast<double>(n);
      declare_zero_crossing(
          {.name = "level",
           .guard = [levels](const At& at, VectorRef out) { out = at.x[0] - levels.array(); },
           .size = n});
      return;
    }
    for (Index i = 0; i < n; ++i) {
      const double level = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      ZeroCrossing crossing{.name = text("level_", i),
                            .guard = [level](const At& at) { return at.x[0] - level; }};
      if (form == Form::reset)
        crossing.reset_map = [](const At& at, Next& next) { next.set_continuous_state({at.x[0]}); };
      declare_zero_crossing(std::move(crossing));
    }
  }
};

/// x' = 1 from 0 on, as an output.
class Ramp final : public LeafSystem {
 public:
  Ramp() : LeafSystem("ramp") {
    declare_continuous_state(
        {.initial = Eigen::VectorXd::Zero(1), .ode = [](const At&) { return 1.0; }});
    declare_output_port({.name = "x", .calc = [](const At& at) { return at.x[0]; }});
  }
};

/// Counts when its input passes a level.
class Mark final : public LeafSystem {
 public:
  Mark(Index i, double level) : LeafSystem(text("mark_", i)) {
    declare_input_port({.shape = Shape::scalar()});
    declare_discrete_state(Eigen::VectorXd::Zero(1));
    declare_zero_crossing(
        {.name = "level",
         .guard = [level](const At& at) { return at.u(0) - level; },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); }});
  }
};

std::shared_ptr<const System> scene(Index n, Form form) {
  if (form != Form::blocks) return std::make_shared<Ruler>(n, form);
  DiagramBuilder builder;
  const Ramp& ramp = builder.add<Ramp>();
  for (Index i = 0; i < n; ++i) {
    const double level = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    builder.connect(ramp.output(), builder.add<Mark>(i, level).input());
  }
  return std::make_shared<Diagram>(builder.build());
}

/// [s] Best of three runs; sets `guard_calls`.
double run(Index n, Form form, std::int64_t& guard_calls) {
  const std::shared_ptr<const System> ruler = scene(n, form);
  const Context context = ruler->create_context();
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < (n > 4000 ? 1 : 3); ++i) {
    Simulator simulator(*ruler, {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5});
    const auto start = std::chrono::steady_clock::now();
    simulator.initialize(context);
    simulator.advance_to(1.0);
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    guard_calls = simulator.results().statistics.guard_calls;
    if (static_cast<Index>(simulator.results().events.size()) != n) std::puts("not all fired");
  }
  return best;
}

int only(std::string_view form, Index n, int runs) {
  const std::shared_ptr<const System> ruler = scene(n, form == "vector"   ? Form::vector
                                                       : form == "single" ? Form::single
                                                       : form == "reset"  ? Form::reset
                                                                          : Form::blocks);
  Simulator simulator(*ruler, {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = Method::dopri5});
  for (int i = 0; i < runs; ++i) {
    simulator.initialize(ruler->create_context());
    simulator.advance_to(1.0);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 3) return only(argv[1], std::atoi(argv[2]), std::atoi(argv[3]));
  bench::Sheet sheet("many_guards", "how does the cost grow with the number of guards?");
  double of_vector = 0.0, of_resets = 0.0;
  for (const auto& [name, form, most] :
       {std::tuple{"vector of monitors", Form::vector, Index{16'000}},
        {"single monitors", Form::single, Index{4'000}},
        {"guards with resets", Form::reset, Index{2'000}},
        {"guards with resets in blocks", Form::blocks, Index{2'000}}}) {
    double before = 0.0;
    for (Index n = most / 16; n <= most; n *= 2) {
      std::int64_t calls = 0;
      const double time = run(n, form, calls);
      bench::Row row{{"guards", name}, {"n", n}, {"time [s]", time}, {"guard calls", calls}};
      row["exponent"] = before > 0.0 ? std::log2(time / before) : 0.0;
      sheet.add(row);
      if (form == Form::vector && n == 8'000) of_vector = time;
      if (form == Form::reset && n == 2'000) of_resets = time;
      before = time;
    }
  }
  sheet.target("8 000 monitors [s]", of_vector, 1.0);
  sheet.target("2 000 guards with resets [s]", of_resets, 1.0);
}
