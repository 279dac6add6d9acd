// A ball on a table that moves as A sin(w t), turned round relative to it: v+ = vt - e (v - vt).
// References: references.py, each flight a parabola, its end found to 30 digits.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 10.0, w = 10.0;

/// Height and velocity of the table: inside the leaf, or from blocks.
struct Table {
  double amplitude;
  double height(double t) const { return amplitude * std::sin(w * t); }
  double velocity(double t) const { return amplitude * w * std::cos(w * t); }
};

template <class Height, class Velocity>
void declare_ball(Leaf& l, double e, Eigen::VectorXd start, Height height, Velocity velocity) {
  l.declare_continuous_state({.initial = std::move(start),
                              .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; },
                              .reads = Reads::continuous_state});
  l.declare_zero_crossing({.name = "bounce",
                           .guard = [=](const At& at) { return at.x[0] - height(at); },
                           .reset_map =
                               [=](const At& at, Next& next) {
                                 const double vt = velocity(at);
                                 next.set_continuous_state({height(at), vt - e * (at.x[1] - vt)});
                               },
                           .direction = Direction::positive_then_non_positive});
}

std::vector<Form> balls(Table table, double e, double y, double v) {
  const auto alone = make_leaf("ball", [=](Leaf& l) {
    declare_ball(
        l, e, vec({y, v}), [=](const At& at) { return table.height(at.time); },
        [=](const At& at) { return table.velocity(at.time); });
  });
  const auto over = make_leaf("ball", [=](Leaf& l) {
    l.declare_input_port({.name = "height", .shape = Shape::scalar()});
    l.declare_input_port({.name = "velocity", .shape = Shape::scalar()});
    declare_ball(
        l, e, vec({y, v}), [](const At& at) { return at.u(0); },
        [](const At& at) { return at.u(1); });
  });
  DiagramBuilder builder;
  builder.add(over);
  auto& height =
      builder.add<Sine>("height", SineOptions{.amplitude = table.amplitude, .frequency = w});
  auto& velocity = builder.add<Sine>("velocity", SineOptions{.amplitude = w * table.amplitude,
                                                             .frequency = w,
                                                             .phase = 0.5 * std::acos(-1.0)});
  builder.connect(height.output(), over->input(0));
  builder.connect(velocity.output(), over->input(1));
  return {{alone, "leaf"}, {std::make_shared<Diagram>(builder.build()), "diagram"}};
}

}  // namespace

TEST_CASE("a ball bounces on a vibrating table as its reference says", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const std::vector<double> times{0.45816443654343801, 1.164961487616494,  1.8331991189585945,
                                  2.5133504825109867,  3.2215304014200725, 3.9017752397183656,
                                  4.4907975408286104,  5.0778054512947632, 5.7081998319737757,
                                  6.3640145936729494,  7.0087769945353289, 7.625770059185937};
  const std::vector<double> speeds{3.5479802977661126, 3.3635504638520779, 3.4371846569977865,
                                   3.591462920435169,  3.4197068445704719, 2.9307361546476211,
                                   2.9087529899059013, 3.1533982947261188, 3.2954431330800392,
                                   3.2318240824402569, 3.0793797163614576, 3.0599911659203577};
  const double rtol = 1e-9, atol = 1e-11;
  for (const Form& form : balls({0.05}, 0.8, 1.0, 0.0)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 7.7},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // references.py: an error of the start reaches a time 7.2 times as large at most, and a speed
    // 38 times. Twelve flights make one each, of 40 steps with a multistep method, of the location
    // of 100 eps (t + h) at relative speeds and table accelerations below 8 with the others.
    const double made = one_step(method) ? 8.0 * 200.0 * eps * 7.7 : 40.0 * (rtol * 5.0 + atol);
    within(text("sine table times ", form.name), method, worst(firing_times(results.events), times),
           12.0 * made * 7.2);
    std::vector<double> found;
    for (std::size_t i = 0; i < results.events.size(); ++i)
      found.push_back(results.events[i].after[1]);
    within(text("sine table speeds ", form.name), method, worst(found, speeds), 12.0 * made * 38.0);
  }
}

// What comes out with adams, bdf and dop853: a landing or a lift-off too few or too many, and so
// another end; dopri5 is right.
TEST_CASE(
    "a ball at rest on a table that falls away faster than gravity lifts off, lands, lifts off",
    "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  // A w^2 = 1.5 g. Put down at t = 0, moving with the table, restitution 0: lift-off where the
  // acceleration of the table is -g, landing where the parabola meets it; there it pushes up.
  const double lift = 0.072972765622696636, land = 0.4295944393154984,
               period = 2.0 * std::acos(-1.0) / w;
  const double rtol = 1e-10, atol = 1e-12;
  for (const Form& form : balls({0.15}, 0.0, 0.0, 1.5)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 3.0 * period},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    std::vector<double> lifts, lands;
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      const Event event = results.events[i];
      if (event.kind == EventKind::zeno_release) lifts.push_back(event.time);
      if (event.kind == EventKind::zero_crossing && event.time > 0.0) lands.push_back(event.time);
    }
    const double flight = one_step(method) ? 400.0 * eps : 40.0 * (rtol * 1.5 + atol);
    // A relative acceleration that passes zero with the slope A w^3 cos(w lift) = 112 m/s^3: atol
    // of height is seen after (6 atol / 112)^(1/3) s.
    const double seen = std::cbrt(6.0 * 1e4 * atol / 112.0);
    within(text("table falls away, lifts ", form.name), method,
           worst(lifts, {lift, lift + period, lift + 2.0 * period}), seen);
    within(text("table falls away, lands ", form.name), method,
           worst(lands, {land, land + period, land + 2.0 * period}), seen + 10.0 * flight);
    const auto& x = results.context.continuous_state();
    within(text("table falls away, end ", form.name), method,
           std::max(std::abs(x[0]), std::abs(x[1] - 1.5)), 1e-6);
  }
}

TEST_CASE("a ball that a mode binds to the table is released where the table falls faster",
          "[laws][ball]") {
  // On the table a mode gives the ball the table's motion, until the table's acceleration is -G:
  // A W^2 = 1.5 G, so W t = asin(2 / 3). Then it flies until it meets the table again. Times: to 30
  // digits, as those of references.py.
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-6, 1e-10), atol = 1e-3 * rtol;
  constexpr double A = 0.01, G = 9.81, e = 0.2;
  const double W = std::sqrt(1.5 * G / A);
  const auto table = [=](double t) { return vec({A * std::sin(W * t), A * W * std::cos(W * t)}); };
  const auto leaf = make_leaf("ball", [=](Leaf& l) {
    l.declare_default_mode(1);
    l.declare_continuous_state({.initial = table(0.0), .ode = [=](const At& at, VectorRef xdot) {
                                  const bool bound = at.mode == 1;
                                  xdot << (bound ? A * W * std::cos(W * at.time) : at.x[1]),
                                      (bound ? -A * W * W * std::sin(W * at.time) : -G);
                                }});
    l.declare_zero_crossing({.name = "impact",
                             .guard = [=](const At& at) { return at.x[0] - table(at.time)[0]; },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   const auto y = table(at.time);
                                   next.set_continuous_state({y[0], y[1] - e * (at.x[1] - y[1])});
                                 },
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 0});
    l.declare_zero_crossing(
        {.name = "lift-off",
         .guard = [=](const At& at) { return G - A * W * W * std::sin(W * at.time); },
         .reset_map = [=](const At& at, Next& next) { next.set_continuous_state(table(at.time)); },
         .direction = Direction::positive_then_non_positive,
         .start_mode = 1,
         .end_mode = 0});
  });
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, 0.12},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  const auto names = firing_names(results.events);
  REQUIRE(names.size() >= 2);
  CHECK(names[0] == "lift-off");
  CHECK(names[1] == "impact");
  const auto times = firing_times(results.events);
  // The lift-off is a guard of time. An error of the height, at most of the size of A, is divided
  // by the relative speed of the impact, above 0.4.
  within("lift-off", method, std::abs(times[0] - 0.019023072927638760), 200.0 * eps * 0.12);
  within("impact after it", method, std::abs(times[1] - 0.111989812619422197),
         2.5 * allowed(method, rtol, atol, A, 10.0));
}
