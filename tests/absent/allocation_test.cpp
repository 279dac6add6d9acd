// Nothing is allocated in the loop when nothing is recorded: a long run asks for memory as often as
// a short one.
#include "support/allocations.hpp"
#include "support/balls.hpp"
#include "support/cases.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Allocations of the second of two advances; the first takes what is needed once.
long of_second_advance(const System& system, const Context& context, double first, double second,
                       SimulatorOptions options) {
  options.record_events = false;
  Simulator simulator(system, options);
  simulator.initialize(context);
  simulator.advance_to(first);
  return allocations_of([&] { simulator.advance_to(second); });
}

/// The second advance of a long run asks for no more than that of a short one.
void loop_is_free(const System& system, const Context& context, double first, double second,
                  double much_later, const SimulatorOptions& options) {
  const long few = of_second_advance(system, context, first, second, options);
  const long many = of_second_advance(system, context, first, much_later, options);
  CHECK(many == few);
}

}  // namespace

TEST_CASE("10000 steps allocate nothing", "[absent][allocation]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf oscillator("oscillator", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
  });
  loop_is_free(oscillator, oscillator.create_context(), 10.0, 20.0, 2000.0,
               {.ode_solver_method = method});
}

TEST_CASE("a stiff scene allocates nothing in its loop", "[absent][allocation]") {
  const Leaf decay("decay", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << -1e4 * (at.x[0] - std::cos(at.time)), at.x[0];
         }});
    l.declare_jacobian([](const At&, MatrixRef j) { j << -1e4, 0.0, 1.0, 0.0; });
  });
  loop_is_free(decay, decay.create_context(), 10.0, 20.0, 500.0,
               {.ode_solver_method = Method::bdf});
}

TEST_CASE("a thousand bounces allocate nothing", "[absent][allocation]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 1.0})) {
    INFO(scene.form << ", method " << method);
    loop_is_free(*scene.system, scene.context(0.1, 0.0), 10.0, 12.0, 300.0,
                 {.ode_solver_method = method});
  }
}

TEST_CASE("changes of mode allocate nothing", "[absent][allocation]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf thermostat("room", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({20.0}), .ode = [](const At& at) {
                                  return (at.mode == 1 ? 30.0 : 10.0) - at.x[0];
                                }});
    l.declare_jacobian([](const At&, MatrixRef j) { j(0, 0) = -1.0; });
    l.declare_default_mode(1);
    l.declare_zero_crossing({.name = "cold",
                             .guard = [](const At& at) { return at.x[0] - 19.0; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "warm",
                             .guard = [](const At& at) { return at.x[0] - 21.0; },
                             .start_mode = 1,
                             .end_mode = 0});
  });
  loop_is_free(thermostat, thermostat.create_context(), 5.0, 6.0, 200.0,
               {.ode_solver_method = method});
}

TEST_CASE("ticks and monitors allocate nothing", "[absent][allocation]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.1);
  auto& integrator = builder.add<Integrator>("integrator");
  auto& above = builder.add<Leaf>("above", [](Leaf& l) {
    l.declare_input_port({.name = "in", .shape = Shape::scalar()});
    l.declare_zero_crossing({.name = "level", .guard = [](const At& at) { return at.u(0); }});
  });
  builder.connect(sine.output(), hold.input());
  builder.connect(hold.output(), integrator.input());
  builder.connect(integrator.output(), above.input());
  const Diagram diagram = builder.build();
  loop_is_free(diagram, diagram.create_context(), 50.0, 51.0, 150.0, {.ode_solver_method = method});
}

namespace {

/// A ball over a floor that drops by 0.1 m each second: contacts, a hold and a release in each.
std::shared_ptr<Leaf> hopper() {
  return make_leaf("hopper", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.1, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0] - at.z[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.z[0], -0.3 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({at.z[0] - 0.1}); }, 1.0, 1.0);
  });
}

/// An oscillator with five guards of one call that reset, and a monitor; a mode that changes at
/// each multiple of pi and makes the third state stiff.
std::shared_ptr<Leaf> all_at_once() {
  return make_leaf("all", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0, 1.0}), .ode = [](const At& at, VectorRef xdot) {
           const double rate = at.mode == 1 ? 1e5 : 1.0;
           xdot << at.x[1], -at.x[0], rate * (std::cos(at.time) - at.x[2]);
         }});
    l.declare_default_mode(0);
    l.declare_zero_crossing(
        {.name = "levels",
         .guard =
             [](const At& at, VectorRef g) {
               for (Index k = 0; k < 5; ++k) g[k] = at.x[0] - 0.2 * (static_cast<double>(k) - 2.0);
             },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state(at.x); },
         .size = 5});
    l.declare_zero_crossing({.name = "monitor", .guard = [](const At& at) { return at.x[1]; }});
    for (const int mode : {0, 1})
      l.declare_zero_crossing(
          {.name = mode == 0 ? "stiffen" : "relax",
           .guard = [mode](const At& at) { return std::sin(at.time) * (mode == 0 ? 1.0 : -1.0); },
           .direction = Direction::negative_then_non_negative,
           .start_mode = mode,
           .end_mode = 1 - mode});
  });
}

}  // namespace

TEST_CASE("holds and releases allocate nothing, in a leaf and in a diagram",
          "[absent][allocation]") {
  const auto method = GENERATE(from_range(methods));
  for (const Form& form : forms(hopper())) {
    INFO(form.name << ", method " << method);
    loop_is_free(*form.system, form.context(), 10.5, 12.5, 60.5, {.ode_solver_method = method});
  }
}

TEST_CASE("holds and releases of balls from blocks allocate nothing", "[absent][allocation]") {
  const auto method = GENERATE(from_range(methods));
  for (const Contact contact : contacts) {
    const BallScene scene =
        blocks(contact, {.e = 0.3},
               std::make_shared<Pulse>("floor", Pulse::Options{.amplitude = 0.1, .period = 2.0}));
    INFO(scene.form << ", method " << method);
    loop_is_free(*scene.system, scene.context(0.2, 0.0), 10.5, 12.5, 60.5,
                 {.ode_solver_method = method});
  }
}

TEST_CASE("guards, resets, monitors and modes at once allocate nothing, in a leaf and in a diagram",
          "[absent][allocation]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::adams, Method::bdf);
  for (const Form& form : forms(all_at_once())) {
    INFO(form.name << ", method " << method);
    loop_is_free(*form.system, form.context(), 13.0, 19.5, 60.0, {.ode_solver_method = method});
  }
}

// What a run reports of its methods grows with their changes: the list of stretches, by doubling.
TEST_CASE("changes between stiff and not allocate nothing but the list of them",
          "[absent][allocation]") {
  for (const Form& form : forms(all_at_once())) {
    INFO(form.name);
    const auto count = [&](double second) {
      Simulator simulator(*form.system,
                          {.ode_solver_method = Method::automatic, .record_events = false});
      simulator.initialize(form.context());
      simulator.advance_to(13.0);
      const long asked = allocations_of([&] { simulator.advance_to(second); });
      return std::pair(asked, simulator.results().statistics.stretches.size());
    };
    const auto [few, before] = count(19.5);
    const auto [many, after] = count(200.0);
    REQUIRE(after >= 2 * before);
    const double doublings = std::log2(static_cast<double>(after) / static_cast<double>(before));
    CHECK(static_cast<double>(many - few) <= doublings + 1.0);
  }
}

namespace {

/// Heat in a rod of 30 points, fed in the middle by cos t; a reset at each zero there.
std::shared_ptr<Leaf> rod() {
  constexpr Index n = 30;
  return make_leaf("rod", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [](const At& at, VectorRef xdot) {
           xdot = -2.0 * at.x;
           xdot.head(n - 1) += at.x.tail(n - 1);
           xdot.tail(n - 1) += at.x.head(n - 1);
           xdot *= 1e4;
           xdot[n / 2] += 1e4 * std::cos(at.time);
         }});
    l.declare_jacobian_sparsity(band_entries(n, 1, 1));
    l.declare_zero_crossing(
        {.name = "half",
         .guard = [](const At& at) { return at.x[n / 2]; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state(at.x); }});
  });
}

void solves_free(LinearSolver solver) {
  const auto method = GENERATE(Method::bdf, Method::automatic);
  for (const Form& form : forms(rod())) {
    INFO(form.name << ", method " << method << ", " << solver);
    loop_is_free(*form.system, form.context(), 20.0, 30.0, 100.0,
                 {.ode_solver_method = method, .linear_solver = solver});
  }
}

}  // namespace

TEST_CASE("elimination, dense and banded, allocates nothing", "[absent][allocation]") {
  solves_free(GENERATE(LinearSolver::dense, LinearSolver::band));
}

// Eigen's SparseLU and IncompleteLUT make their working memory anew for each factorisation, by some
// 25 requests; what CVODE, Newton and the solves do in between asks for none.
TEST_CASE("sparse factors allocate in factorisations only", "[absent][allocation]") {
  const auto solver = GENERATE(LinearSolver::sparse, LinearSolver::gmres);
  const auto method = GENERATE(Method::bdf, Method::automatic);
  for (const Form& form : forms(rod())) {
    INFO(form.name << ", method " << method << ", " << solver);
    Simulator simulator(
        *form.system,
        {.ode_solver_method = method, .linear_solver = solver, .record_events = false});
    simulator.initialize(form.context());
    simulator.advance_to(20.0);
    const auto setups = [&] { return simulator.results().statistics.linear_setups; };
    const auto before = setups();
    const long asked = allocations_of([&] { simulator.advance_to(100.0); });
    CHECK(setups() - before > 100);
    CHECK(asked <= 30 * (setups() - before));
  }
}
