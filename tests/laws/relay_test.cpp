// Relays: with hysteresis over a first-order lag and a double integrator, and a bare one over a
// double integrator from blocks. Every piece is a parabola or an exponential.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

enum { up = 1, down = 2 };

/// y is the first state; the relay pushes up until y reaches `band`, then down until -band.
template <class Ode>
std::shared_ptr<Leaf> relay(double band, Eigen::VectorXd start, Ode ode) {
  return make_leaf("relay", [=](Leaf& l) {
    l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                  ode(at, at.mode == up ? 1.0 : -1.0, xdot);
                                }});
    l.declare_default_mode(up);
    l.declare_zero_crossing({.name = "high",
                             .guard = [=](const At& at) { return at.x[0] - band; },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = up,
                             .end_mode = down});
    l.declare_zero_crossing({.name = "low",
                             .guard = [=](const At& at) { return at.x[0] + band; },
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = down,
                             .end_mode = up});
  });
}

/// x'' = -sign(x), from blocks: a bare relay.
Diagram bare_relay() {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 0.5});
  auto& v = builder.add<Integrator>("v", Integrator::Options{.initial_state = 0.0});
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& minus = builder.add<Constant>("minus", -1.0);
  auto& plus = builder.add<Constant>("plus", 1.0);
  auto& above = builder.add<Comparator>("above", ">");
  auto& force = builder.add<Switch>("force");
  builder.connect(v.output(), x.input()), builder.connect(force.output(), v.input());
  builder.connect(x.output(), above.input(0)), builder.connect(zero.output(), above.input(1));
  builder.connect(above.output(), force.input("control"));
  builder.connect(minus.output(), force.input("true_value"));
  builder.connect(plus.output(), force.input("false_value"));
  return builder.build();
}

}  // namespace

TEST_CASE("a relay over a first-order lag switches with one period", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  const double band = GENERATE(0.5, 0.01);
  const double rtol = 1e-9, atol = 1e-11;
  const auto lag = relay(band, vec({-band}),
                         [](const At& at, double u, VectorRef xdot) { xdot << u - at.x[0]; });
  for (const Form& form : forms(lag)) {
    const int n = 1000;
    const double half = std::log((1.0 + band) / (1.0 - band));  // from -band to band, towards 1
    std::vector<double> expected;
    for (int k = 1; k <= n; ++k) expected.push_back(k * half);
    const auto results = simulate(*form.system, form.context(), {0.0, (n + 0.5) * half},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // Each half period starts anew from the band, so its error is one of time, dx over the speed
    // 1 - band at the switch; they add up.
    const double once = allowed(method, rtol, atol, band) / (1.0 - band) + 200.0 * eps * n * half;
    within(text("relay lag ", band, " ", form.name), method,
           worst(firing_times(results.events), expected), n * once);
  }
}

TEST_CASE("a relay with hysteresis over a double integrator pumps it up", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = 1e-10, atol = 1e-12, band = 0.25, v0 = 1.0;
  const auto pumped = relay(band, vec({-band, v0}),
                            [](const At& at, double u, VectorRef xdot) { xdot << at.x[1], u; });
  for (const Form& form : forms(pumped)) {
    // Out beyond an edge with the speed V, turned round by the push, across the band with it:
    // V^2 grows by 4 band, in the time V + V_next. The first crossing begins at the edge, inward.
    const int n = 60;
    std::vector<double> expected;
    double t = 0.0, v = v0;
    for (int k = 0; k < n; ++k) {
      const double next = std::sqrt(v * v + 4.0 * band);
      t += k == 0 ? next - v : next + v;
      expected.push_back(t);
      v = next;
    }
    const auto results = simulate(*form.system, form.context(), {0.0, t + v},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // Parabolas: what a multistep method errs in v, 40 steps a piece, later pieces carry on, as a
    // time, twice each; a location errs by 100 eps (t + h).
    const double made = (one_step(method) ? 0.0 : 40.0 * (rtol * v + atol)) + 400.0 * eps * t;
    within(text("relay double integrator ", form.name), method,
           worst(firing_times(results.events), expected), n * 2.0 * n * made);
  }
}

TEST_CASE("a bare relay over a double integrator keeps its period", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = 1e-10, atol = 1e-12;
  const Diagram diagram = bare_relay();
  const int n = 50;
  // From 0.5 at rest: v = -1 at x = 0 after 1 s, again with v = 1 after 2 s more, and so on.
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0 * n},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  std::vector<double> expected;
  for (int k = 1; k <= n; ++k) expected.push_back(2.0 * k - 1.0);
  const double made = (one_step(method) ? 0.0 : 40.0 * (rtol + atol)) + 400.0 * eps * 2.0 * n;
  within("bare relay of blocks, times", method, worst(results.events.times("difference"), expected),
         n * 2.0 * n * made);
  // At 100 s it is at its apex on the other side or this: |x| = 0.5.
  within("bare relay of blocks, energy", method,
         std::abs(std::abs(results.context.continuous_state()[0]) +
                  0.5 * std::pow(results.context.continuous_state()[1], 2) - 0.5),
         2.0 * n * made);
}
