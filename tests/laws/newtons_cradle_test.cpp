// Newton's cradle: three equal balls that touch, elastic. Impacts at one instant, in one leaf and
// across blocks: momentum goes through, nothing passes through.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

/// State: three places, three velocities. Each swings about the place where it hangs, x'' = h - x;
/// a pair that meets swaps velocities.
std::shared_ptr<Leaf> cradle(const Eigen::VectorXd& places,
                             const Eigen::VectorXd& hangs = vec({0.0, 0.0, 0.0})) {
  return make_leaf("cradle", [=](Leaf& l) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(6);
    start.head(3) = places;
    l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                  xdot << at.x.tail(3), hangs - at.x.head(3);
                                }});
    for (int i = 0; i < 2; ++i) {
      l.declare_zero_crossing({.name = i == 0 ? "first_pair" : "second_pair",
                               .guard = [=](const At& at) { return at.x[i + 1] - at.x[i]; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     Eigen::VectorXd x = at.x;
                                     std::swap(x[3 + i], x[4 + i]);
                                     next.set_continuous_state(x);
                                   },
                               .direction = Direction::positive_then_non_positive});
    }
  });
}

/// The same from three blocks: a ball swaps velocities with a neighbour it meets, each on its own.
std::shared_ptr<const Diagram> cradle_of_blocks(double gap) {
  DiagramBuilder builder;
  std::vector<std::shared_ptr<Leaf>> balls;
  for (int i = 0; i < 3; ++i) {
    const double hang = i == 2 ? gap : 0.0;
    balls.push_back(make_leaf(text("ball_", i), [=](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({i == 0 ? -1.0 : hang, 0.0}),
           .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], hang - at.x[0]; },
           .reads = Reads::continuous_state});
      l.declare_continuous_state_output("state");
      for (const int side : {-1, 1}) {
        if (i + side < 0 || i + side > 2) continue;
        const int in =
            l.declare_input_port({.name = side < 0 ? "left" : "right", .shape = Shape::of(2)});
        l.declare_zero_crossing(
            {.name = side < 0 ? "meets_left" : "meets_right",
             .guard = [=](const At& at) { return side * (at.u[in][0] - at.x[0]); },
             .reset_map = [=](const At& at,
                              Next& next) { next.set_continuous_state({at.x[0], at.u[in][1]}); },
             .direction = Direction::positive_then_non_positive});
      }
    }));
    builder.add(balls.back());
  }
  builder.connect(balls[1]->output(), balls[0]->input("right"));
  builder.connect(balls[0]->output(), balls[1]->input("left"));
  builder.connect(balls[2]->output(), balls[1]->input("right"));
  builder.connect(balls[1]->output(), balls[2]->input("left"));
  return std::make_shared<Diagram>(builder.build());
}

struct Cradle {
  Method method;
  double rtol = 1e-10, atol = 1e-12;
  /// Three quarter turns are 2.4 half ones; an oscillator does not let errors grow, they add up.
  double tolerance = allowed(method, 1e-10, 1e-12, 1.0, 5.0 * 3.15);

  Results run(const System& system, double end) const {
    return simulate(
        system, system.create_context(), {0.0, end},
        {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
  }
};

}  // namespace

TEST_CASE("a ball that meets two that touch sends the last one off", "[laws]") {
  const Cradle c{.method = GENERATE(from_range(methods))};
  const double gap = GENERATE(1e-3, 1e-9);  // between the balls at rest: one after the other
  // The first, let go at -1, meets the second at pi/2; that meets the third after the gap. They
  // come back at 3/2 pi.
  for (const Form& form : forms(cradle(vec({-1.0, 0.0, gap}), vec({0.0, 0.0, gap})))) {
    const auto results = c.run(*form.system, pi - 0.1);
    CHECK(results.status == Status::reached_end);
    const auto& x = results.context.continuous_state();
    // The ball that was hit last swings like cos(t - pi) now; the others swing by the gap,
    // the second to be back at the first at pi.
    within(text("cradle gap ", gap, " ", form.name), c.method,
           std::max({std::abs(x[2] - std::cos(0.1)), std::abs(x[0]), std::abs(x[1]), std::abs(x[3]),
                     std::abs(x[4])}),
           c.tolerance + 2.0 * gap);
    CHECK(firing_names(results.events) == std::vector<std::string>{"first_pair", "second_pair"});
  }
}

TEST_CASE("a ball that meets two that touch exactly sends the last one off", "[laws]") {
  const Cradle c{.method = GENERATE(from_range(methods))};
  for (const Form& form : forms(cradle(vec({-1.0, 0.0, 0.0})))) {
    const auto results = c.run(*form.system, pi);
    CHECK(results.status == Status::reached_end);
    const auto& x = results.context.continuous_state();
    within(text("cradle touching ", form.name), c.method,
           std::max({std::abs(x[2] - 1.0), std::abs(x[0]), std::abs(x[1]), std::abs(x[3]),
                     std::abs(x[4])}),
           c.tolerance);
    CHECK(firing_names(results.events) == std::vector<std::string>{"first_pair", "second_pair"});
  }
}

TEST_CASE("two outer balls that meet the middle one at one instant bounce back", "[laws]") {
  const Cradle c{.method = GENERATE(from_range(methods))};
  for (const Form& form : forms(cradle(vec({-1.0, 0.0, 1.0})))) {
    const auto results = c.run(*form.system, pi);
    CHECK(results.status == Status::reached_end);
    const auto& x = results.context.continuous_state();
    // Swaps sort the velocities (1, 0, -1) into (-1, 0, 1): first, second, first pair again.
    within(text("cradle both sides ", form.name), c.method,
           std::max({std::abs(x[0] + 1.0), std::abs(x[1]), std::abs(x[2] - 1.0)}), c.tolerance);
    CHECK(firing_names(results.events).size() == 3);
  }
}

TEST_CASE("across blocks both sides of an impact see the velocity before it", "[laws]") {
  const Cradle c{.method = GENERATE(from_range(methods))};
  const auto system = cradle_of_blocks(1e-3);
  const auto results = c.run(*system, pi - 0.1);
  CHECK(results.status == Status::reached_end);
  const auto& x = results.context.continuous_state();  // (deflection, velocity) of each
  within("cradle of blocks", c.method,
         std::max({std::abs(x[4] - std::cos(0.1)), std::abs(x[0]), std::abs(x[2])}),
         c.tolerance + 2e-3);
  CHECK(firing_names(results.events) ==
        std::vector<std::string>{"meets_right", "meets_left", "meets_right", "meets_left"});
}

TEST_CASE("no ball of four or more that touch passes another, swing after swing", "[laws]") {
  // The balls at rest lie within 1e-17 of each other and move at 1e-33: impacts among that noise
  // may come or not, but a ball that is clearly on its side of its neighbour stays there. At each
  // impact of a ball of speed 1 the guards are right to a rounding, between them to the tolerance.
  const auto method = GENERATE(from_range(methods));
  const Index n = GENERATE(4, 5, 6);
  const double tolerance = GENERATE(1e-3, 1e-4, 1e-6, 1e-9);
  const auto system = make_leaf("cradle", [=](Leaf& l) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n);
    start[0] = -1.0;
    l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                  xdot << at.x.tail(n), -at.x.head(n);
                                }});
    l.declare_continuous_state_output("x");
    l.declare_zero_crossing(
        {.name = "impact",
         .guard = [=](const At& at, VectorRef g) { g = at.x.segment(1, n - 1) - at.x.head(n - 1); },
         .reset_map =
             [=](const At& at, Next& next) {
               Eigen::VectorXd x = at.x;
               std::swap(x[n + at.entry], x[n + at.entry + 1]);
               next.set_continuous_state(x);
             },
         .direction = Direction::positive_then_non_positive,
         .size = n - 1});
  });
  const auto results = simulate(*system, system->create_context(), {0.0, 10.0},
                                {.rtol = tolerance,
                                 .atol = tolerance,
                                 .ode_solver_method = method,
                                 .recorded_signals = {{"x", system->output()}}});
  const auto x = results.output("x");
  const double deepest = (x.middleCols(1, n - 1) - x.leftCols(n - 1)).minCoeff();
  INFO(method << ", " << n << " balls, tolerance " << tolerance << ": " << deepest);
  CHECK(deepest > -30.0 * tolerance);
}

namespace {

/// n balls that hang at 0, d, 2 d, ... and touch there, as one leaf: x_i'' = i d - x_i. The first
/// `lifted` of them begin at -angle from there. A pair that meets swaps velocities.
struct Row {
  Index n, lifted;
  double d, angle;

  std::shared_ptr<Leaf> system() const {
    return make_leaf("row", [row = *this](Leaf& l) {
      const Index size = row.n;
      const double apart = row.d;
      const Eigen::VectorXd hangs = Eigen::VectorXd::LinSpaced(size, 0.0, apart * double(size - 1));
      Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * size);
      start.head(size) = hangs;
      start.head(row.lifted).array() -= row.angle;
      l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                    xdot << at.x.tail(size), hangs - at.x.head(size);
                                  }});
      l.declare_continuous_state_output("x");
      for (Index i = 0; i + 1 < size; ++i)
        l.declare_zero_crossing(
            {.name = text("pair_", i),
             .guard = [=](const At& at) { return at.x[i + 1] - at.x[i] - apart; },
             .reset_map =
                 [=](const At& at, Next& next) {
                   Eigen::VectorXd x = at.x;
                   std::swap(x[size + i], x[size + i + 1]);
                   next.set_continuous_state(x);
                 },
             .direction = Direction::positive_then_non_positive,
             .holds = {{int(i), int(i) + 1, int(size + i), int(size + i) + 1}}});
    });
  }
};

}  // namespace

TEST_CASE("as many balls fly off as fly in, however many touch, swing after swing", "[laws]") {
  // Balls that touch overlap by roundings of their places, which grow with d. Swaps of velocities let
  // no ball pass: after an odd number of half turns as many balls are out at the other end.
  const auto method = GENERATE(from_range(methods));
  const double tolerance = GENERATE(1e-6, 1e-9);
  const Row row = GENERATE(Row{3, 1, 0.1, 1.0}, Row{4, 2, 1.0, 0.5}, Row{5, 1, 0.1, 0.543},
                           Row{6, 5, 0.0, 0.48});
  const double end = 9.0 * pi;  // nine half turns
  const auto system = row.system();
  const auto results = simulate(*system, system->create_context(), {0.0, end},
                                {.rtol = tolerance,
                                 .atol = tolerance,
                                 .ode_solver_method = method,
                                 .recorded_signals = {{"x", system->output()}}});
  const auto x = results.output("x");
  const double deepest =
      (x.middleCols(1, row.n - 1) - x.leftCols(row.n - 1)).array().minCoeff() - row.d;
  INFO(method << ", " << row.lifted << " of " << row.n << " balls, " << row.d
              << " apart, tolerance " << tolerance << ": " << deepest);
  // Each ball may be wrong by the error of the run; a ball that passes is wrong by the angle.
  CHECK(deepest > -0.1 * row.angle);
  const auto& last = results.context.continuous_state();
  for (Index i = 0; i < row.n; ++i) {
    const double out = i < row.n - row.lifted ? 0.0 : row.angle;
    CHECK(std::abs(last[i] - row.d * double(i) - out) < 0.1 * row.angle);
  }
}
