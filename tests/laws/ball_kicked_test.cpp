// A ball at rest that something throws up again: a tick of its own, a signal of another block.
// Kicked upward it flies, kicked downward it stays.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 10.0;

template <class Declare>
std::shared_ptr<Leaf> ball(double e, Declare kick) {
  return make_leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    kick(l);
  });
}

/// Kicked with v at 1 s, 3 s, ...: by its own tick; by a held signal that its reset map reads.
std::vector<Form> kicked(double e, double v) {
  const auto by_tick = ball(e, [=](Leaf& l) {
    l.declare_periodic_update(
        [=](const At& at, Next& next) { next.set_continuous_state({at.x[0], v}); }, 2.0, 1.0);
  });
  const auto by_signal = ball(e, [=](Leaf& l) {
    const int in = l.declare_input_port({.name = "kick", .shape = Shape::scalar()});
    l.declare_edge_reset({.name = "kick", .input = in, .reset_map = [=](const At& at, Next& next) {
                            next.set_continuous_state({at.x[0], v});
                          }});
  });
  DiagramBuilder builder;
  builder.add(by_signal);
  auto& pulse = builder.add<Pulse>("pulse", PulseOptions{.period = 2.0, .phase_delay = 1.0});
  builder.connect(pulse.output(), by_signal->input("kick"));
  return {{by_tick, "leaf, own tick"},
          {std::make_shared<Diagram>(builder.build()), "edge of a signal"}};
}

}  // namespace

TEST_CASE("a ball at rest that is kicked up flies, comes down, and rests until the next kick",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.5);
  const double rtol = 1e-9, atol = 1e-11;
  for (const Form& form : kicked(e, 4.0)) {
    // Thrown with 4 m/s: at 0.3 s it is 0.75 m high; back after 0.8 s; at rest 0.8 / (1 - e) after.
    for (const auto& [t, y, v] : {std::array{1.3, 0.75, 1.0}, std::array{2.9, 0.0, 0.0},
                                  std::array{5.3, 0.75, 1.0}, std::array{6.9, 0.0, 0.0}}) {
      const auto results = simulate(
          *form.system, form.context(), {0.0, t},
          {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
      CHECK(results.status == Status::reached_end);
      const auto& x = results.context.continuous_state();
      // A flight from a state the kick says, of 40 steps with a multistep method; a rest to 1e-9,
      // or where a flight is too low for atol to see.
      const double tolerance =
          v != 0.0 ? (one_step(method) ? 100.0 * eps * 6.0 : 40.0 * (rtol * 4.0 + atol)) : 1e-8;
      within(text("kicked ball, ", form.name), method,
             std::max(std::abs(x[0] - y), std::abs(x[1] - v)), tolerance);
    }
  }
}

TEST_CASE("a ball at rest that is kicked down stays where it is", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  for (const Form& form : kicked(0.0, -4.0)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 6.9},
                                  {.ode_solver_method = method, .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    within(text("ball kicked down, ", form.name), method,
           results.context.continuous_state().cwiseAbs().maxCoeff(), 1e-9);
  }
  // With e = 0.5 the floor throws it back up with 2 m/s: it is 0.15 m high 0.1 s later.
  for (const Form& form : kicked(0.5, -4.0)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 1.1},
                                  {.ode_solver_method = method, .throw_errors = false});
    within(text("ball kicked down, e=0.5, ", form.name), method,
           std::abs(results.context.continuous_state()[0] - 0.15), 40.0 * (1e-6 * 2.0 + 1e-8));
  }
}
