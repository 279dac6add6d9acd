// A ball on a floor that gives: y'' = -g above it, y'' = -g - k y below. No reset at all, one kink
// of the force; contact is half a turn and a bit of an oscillator, flight a parabola, energy stays.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81, height = 1.0;

enum class Way { modes, relation, saturate };

/// The force -k min(y, 0): by two modes, by a relation, from blocks with Saturate.
Form ball(Way way, double k) {
  if (way == Way::saturate) {
    DiagramBuilder builder;
    auto& y = builder.add<Integrator>("y", Integrator::Options{.initial_state = height});
    auto& v = builder.add<Integrator>("v", Integrator::Options{.initial_state = 0.0});
    auto& below = builder.add<Saturate>("below", SaturateOptions{.upper_limit = 0.0});
    auto& spring = builder.add<Gain>("spring", -k);
    auto& weight = builder.add<Offset>("weight", -g);
    builder.connect(v.output(), y.input()), builder.connect(y.output(), below.input());
    builder.connect(below.output(), spring.input()),
        builder.connect(spring.output(), weight.input());
    builder.connect(weight.output(), v.input());
    return {std::make_shared<Diagram>(builder.build()), "blocks with Saturate"};
  }
  return {make_leaf("ball",
                    [=](Leaf& l) {
                      const bool modes = way == Way::modes;
                      RelationIndex touches;
                      if (modes) {
                        l.declare_default_mode(0);
                        l.declare_zero_crossing({.name = "lands",
                                                 .guard = [](const At& at) { return at.x[0]; },
                                                 .direction = Direction::positive_then_non_positive,
                                                 .start_mode = 0,
                                                 .end_mode = 1});
                        l.declare_zero_crossing({.name = "leaves",
                                                 .guard = [](const At& at) { return at.x[0]; },
                                                 .direction = Direction::negative_then_non_negative,
                                                 .start_mode = 1,
                                                 .end_mode = 0});
                      } else {
                        touches = l.declare_relation(
                            {.name = "touches", .guard = [](const At& at) { return -at.x[0]; }});
                      }
                      l.declare_continuous_state(
                          {.initial = vec({height, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
                             const bool down = modes ? at.mode == 1 : at.relation(touches);
                             xdot << at.x[1], -g - (down ? k * at.x[0] : 0.0);
                           }});
                    }),
          way == Way::modes ? "leaf with modes" : "leaf with a relation"};
}

}  // namespace

TEST_CASE("a ball on a springy floor lands and leaves when the half turns say", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const double k = GENERATE(1e2, 1e4, 1e6);
  const double rtol = 1e-10, atol = 1e-12;
  // Down with v for sqrt(2 height / g); below, about -g/k, for 2 (pi - atan(v w / g)) / w with w^2
  // = k.
  const double w = std::sqrt(k), flight = std::sqrt(2.0 * height / g), v = g * flight;
  const double contact = 2.0 * (std::acos(-1.0) - std::atan(v * w / g)) / w;
  const int n = 10;
  std::vector<double> expected;
  for (int i = 0; i < n; ++i) {
    const double lands = flight + i * (contact + 2.0 * flight);
    expected.push_back(lands), expected.push_back(lands + contact);
  }
  for (const Way way : {Way::modes, Way::relation, Way::saturate}) {
    const Form form = ball(way, k);
    const auto results = simulate(*form.system, form.context(), {0.0, expected.back() + flight},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // An error of y below is one of speed w times as large, and of the time after it by 2 w / g;
    // the errors of y there are rtol of a depth v / w and atol. Those of v are rtol v. n contacts,
    // each carried on through the flights after it.
    // "auto" may take BDF on so stiff a spring, and then has its tolerance.
    const bool bdf = results.statistics.method.find("bdf") != std::string::npos;
    const double made = allowed(bdf ? Method::bdf : method, rtol, atol * w, v) * 2.0 / g;
    within(text("springy floor k=", k, ", ", form.name), method,
           worst(firing_times(results.events), expected), n * n * made);
  }
}

// Three ways to the same equation: the same equation.
TEST_CASE("modes, a relation and Saturate say the same of a springy floor", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  std::vector<Eigen::VectorXd> ends;
  for (const Way way : {Way::modes, Way::relation, Way::saturate}) {
    const Form form = ball(way, 1e4);
    ends.push_back(simulate(*form.system, form.context(), {0.0, 3.0},
                            {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method})
                       .context.continuous_state());
  }
  // As above, four contacts; a time is a height times v, a speed times g.
  const double tolerance = 16.0 * allowed(method, 1e-10, 1e-10, 4.43) * 2.0;
  for (std::size_t i : {1U, 2U}) {
    within(text("springy floor, three ways ", i), method, (ends[i] - ends[0]).cwiseAbs().maxCoeff(),
           tolerance);
  }
}
