// What does a part of the engine cost that a scene does not need, or hardly needs? The program runs
// the same scene with and without the part: a guard that never fires, a recorder of two signals,
// the Zeno monitor, a monitor guard that is located, unread blocks and constants that could be
// folded. dopri5 at rtol 1e-6, dop853 at 1e-8. `absent NAME off 3` makes one run of one side, three
// times as long, for bench/instructions.py.
#include <cstring>
#include <numbers>
#include <saltus/library/library.hpp>

#include "ball.hpp"
#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using bench::Runner;
using saltus::At, saltus::VectorRef, saltus::SimulatorOptions;

/// The equation of Kepler's orbit, with GM = 1.
void gravity(const At& at, VectorRef xdot) {
  const double r2 = at.x[0] * at.x[0] + at.x[1] * at.x[1], w = -1.0 / (r2 * std::sqrt(r2));
  xdot << at.x[2], at.x[3], w * at.x[0], w * at.x[1];
}

/// Kepler's ellipse, e = 0.6, ten turns, with the named guard: "never" stays positive, "apsis"
/// crosses zero twenty times. The right-hand side is called, or inlined into the steps.
class Planet final : public saltus::LeafSystem {
 public:
  explicit Planet(const std::string& guard = "", bool inlined = false) : LeafSystem("planet") {
    using saltus::RightHandSide;
    declare_continuous_state({.initial = Eigen::Vector4d(0.4, 0.0, 0.0, 2.0),
                              .ode = inlined ? saltus::inlined<4>([](const At& at, VectorRef xdot) {
                                gravity(at, xdot);
                              })
                                             : RightHandSide(&Planet::ode)});
    declare_output_port({.name = "x", .view = saltus::Place{saltus::Space::x, 0, 1}});
    declare_output_port({.name = "y", .view = saltus::Place{saltus::Space::x, 1, 1}});
    if (guard == "never")
      declare_zero_crossing({.name = guard, .guard = [](const At& at) { return at.x[0] + 10.0; }});
    if (guard == "apsis")
      declare_zero_crossing({.name = guard, .guard = [](const At& at) {
                               return at.x[0] * at.x[2] + at.x[1] * at.x[3];
                             }});
  }

 private:
  void ode(const At& at, VectorRef xdot) const { gravity(at, xdot); }
};

/// The same orbit as a diagram: the guard belongs to a block that reads the planet's position.
class Watcher final : public saltus::LeafSystem {
 public:
  Watcher() : LeafSystem("watcher") {
    declare_input_port();
    declare_zero_crossing(
        {.name = "never", .guard = [](const At& at) { return at.u[0][0] + 10.0; }});
  }
};

SimulatorOptions dopri5() {
  return {.rtol = 1e-6, .atol = 1e-6, .ode_solver_method = saltus::Method::dopri5};
}
SimulatorOptions dop853() {
  return {.rtol = 1e-8, .atol = 1e-8, .ode_solver_method = saltus::Method::dop853};
}

constexpr double ten_turns = 20.0 * std::numbers::pi;

Runner planet_by(const SimulatorOptions& options, bool inlined, double stretch,
                 const std::string& guard) {
  const auto system = std::make_shared<Planet>(guard, inlined);
  return {system, system->create_context(), ten_turns * stretch, options};
}

Runner planet_in_diagram(double stretch, bool watched) {
  saltus::DiagramBuilder builder;
  const auto& planet = builder.add<Planet>();
  if (watched) builder.connect(planet.output(0), builder.add<Watcher>().input(0));
  const auto diagram = std::make_shared<const saltus::Diagram>(builder.build("orbit"));
  return {diagram, diagram->create_context(), ten_turns * stretch, dopri5()};
}

Runner planet(double stretch, const std::string& guard, bool recorded = false) {
  const auto system = std::make_shared<Planet>(guard);
  SimulatorOptions options = dopri5();
  if (recorded) options.recorded_signals = {{"x", system->output(0)}, {"y", system->output(1)}};
  return {system, system->create_context(), ten_turns * stretch, options};
}

/// The floor takes no energy: drag alone makes the flights shorter, so the monitor must check them.
Runner ball(double stretch, double zeno_tolerance) {
  const auto system = std::make_shared<bench::BallLeaf>(bench::Ball{.e = 1.0, .k = 9.81 / 400.0});
  SimulatorOptions options = dopri5();
  options.zeno_tolerance = zeno_tolerance;
  return {system, system->create_context().with_continuous_state(Eigen::Vector2d(10.0, 0.0)),
          20.0 * stretch, options};
}

/// x'' = 1 - x from blocks. With ballast the 1 is 0.5 * 2 + 0, and four more blocks are unread.
Runner oscillator(bool ballast, double stretch) {
  using namespace saltus;
  DiagramBuilder builder;
  auto& v = builder.add<Integrator>("v", Integrator::Options{});
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  auto& spring = builder.add<Gain>("spring", -1.0);
  auto& sum = builder.add<Adder>("sum", "++");
  auto& push = builder.add<Constant>("push", ballast ? 0.5 : 1.0);
  builder.connect(v.output(), x.input());
  builder.connect(x.output(), spring.input());
  builder.connect(spring.output(), sum.input(0));
  builder.connect(sum.output(), v.input());
  if (!ballast) {
    builder.connect(push.output(), sum.input(1));
  } else {
    auto& twice = builder.add<Gain>("twice", 2.0);
    auto& more = builder.add<Offset>("more", 0.0);
    builder.connect(push.output(), twice.input());
    builder.connect(twice.output(), more.input());
    builder.connect(more.output(), sum.input(1));
    auto& sine = builder.add<Sine>("sine", Sine::Options{});
    auto& power = builder.add<Product>("power", "**");
    auto& loud = builder.add<Gain>("loud", 3.0);
    auto& all = builder.add<Adder>("all", "++");
    builder.connect(x.output(), power.input(0));
    builder.connect(v.output(), power.input(1));
    builder.connect(power.output(), loud.input());
    builder.connect(loud.output(), all.input(0));
    builder.connect(sine.output(), all.input(1));
  }
  const auto diagram = std::make_shared<const Diagram>(builder.build("oscillator"));
  return {diagram, diagram->create_context(), 100.0 * stretch, dopri5()};
}

struct Pair {
  const char* name;
  const char* what;
  Runner (*make)(bool on, double stretch);
  double limit;  ///< of the ratio; 0: judged by steps and restarts, or by instructions
};

const std::vector<Pair> pairs{
    {"guard", "a guard that never fires",
     [](bool on, double stretch) { return planet(stretch, on ? "never" : ""); }, 1.05},
    {"guard_dop853", "the same guard, dop853",
     [](bool on, double stretch) { return planet_by(dop853(), false, stretch, on ? "never" : ""); },
     1.05},
    {"guard_inlined", "the same guard, dopri5 inlined",
     [](bool on, double stretch) { return planet_by(dopri5(), true, stretch, on ? "never" : ""); },
     1.05},
    {"guard_inlined_853", "the same guard, dop853 inlined",
     [](bool on, double stretch) { return planet_by(dop853(), true, stretch, on ? "never" : ""); },
     1.05},
    {"guard_plan", "the same guard in another block",
     [](bool on, double stretch) { return planet_in_diagram(stretch, on); }, 1.05},
    {"recorder", "two signals recorded",
     [](bool on, double stretch) { return planet(stretch, "", on); }, 1.15},
    {"zeno", "the Zeno monitor",
     [](bool on, double stretch) { return ball(stretch, on ? 1e-6 : 0.0); }, 1.02},
    {"monitor", "a monitor guard, located 20 times",
     [](bool on, double stretch) { return planet(stretch, on ? "apsis" : ""); }, 1.20},
    {"monitor_dop853", "the same monitor, dop853",
     [](bool on, double stretch) { return planet_by(dop853(), false, stretch, on ? "apsis" : ""); },
     1.20},
    {"ballast", "unread blocks, constants to fold", oscillator, 0.0}};

void compare(bench::Sheet& sheet, const Pair& pair) {
  Runner off = pair.make(false, 1.0), on = pair.make(true, 1.0);
  const auto times = bench::interleave({[&] { off(); }, [&] { on(); }}, 51);
  const auto &a = off.statistics(), &b = on.statistics();
  const double apart = (off.state() - on.state()).cwiseAbs().maxCoeff();
  sheet.add({{"what", pair.what},
             {"without [us]", times[0].time * 1e6},
             {"with [us]", times[1].time * 1e6},
             {"ratio", times[1].ratio},
             {"steps without", a.steps},
             {"steps with", b.steps},
             {"restarts without", a.restarts},
             {"restarts with", b.restarts},
             {"ends apart", apart}});
  if (pair.limit > 0.0) sheet.target(pair.what, times[1].ratio, pair.limit);
  if (std::string_view(pair.name).starts_with("monitor")) {
    sheet.target(saltus::text(pair.what, ": restarts it adds"),
                 static_cast<double>(b.restarts - a.restarts), 0.0);
    sheet.target(saltus::text(pair.what, ": by how much it moves the end"), apart, 0.0);
  }
}

int only(const std::string& name, bool on, double stretch) {
  const auto pair = std::ranges::find(pairs, name, &Pair::name);
  if (pair == pairs.end()) return 2;
  pair->make(on, stretch)();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4) return only(argv[1], std::strcmp(argv[2], "on") == 0, std::atof(argv[3]));
  bench::Sheet sheet("absent", "What does machinery cost that a scene does not need?");
  for (const Pair& pair : pairs) compare(sheet, pair);
}
