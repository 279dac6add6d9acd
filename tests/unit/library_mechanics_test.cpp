// Backlash and MassWithFriction: their modes, and what must not end or begin a contact.
#include <cmath>
#include <numbers>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double pi = std::numbers::pi;

/// u = 2 sin t and its rate.
const auto swing = [](DiagramBuilder& builder, auto& block) {
  const Sine::Options rate{.amplitude = 2.0, .phase = 0.5 * pi};
  builder.connect(builder.add<Sine>("u", Sine::Options{.amplitude = 2.0}).output(), block.input(0));
  builder.connect(builder.add<Sine>("rate", rate).output(), block.input(1));
};

/// u is the integral of a rate that is 1, 0, 1 and -1 for a second each.
const auto stop_and_go = [](DiagramBuilder& builder, auto& block) {
  const Eigen::Vector4d times(0.0, 1.0, 2.0, 3.0), rates(1.0, 0.0, 1.0, -1.0);
  auto& rate = builder.add<DataSource>("rate", times, rates,
                                       DataSource::Options{.interpolation = "zero_order_hold"});
  auto& u = builder.add<Integrator>("u");
  builder.connect(rate.output(), u.input());
  builder.connect(u.output(), block.input(0));
  builder.connect(rate.output(), block.input(1));
};

/// A force of three levels, for a second each.
auto pushed(double first, double second, double third) {
  return [=](DiagramBuilder& builder, auto& block) {
    const Eigen::Vector3d times(0.0, 1.0, 2.0), forces(first, second, third);
    auto& force = builder.add<DataSource>("force", times, forces,
                                          DataSource::Options{.interpolation = "zero_order_hold"});
    builder.connect(force.output(), block.input());
  };
}

std::size_t events(const Results& results, const std::string& name) {
  return results.events.times("block." + name).size();
}

}  // namespace

/// u = 2 sin t drives it from u = 1/2 up to 2, from 1 down to -2, and from -1 up.
TEST_CASE("a Backlash rests in its play and follows in contact", "[library][mechanics]") {
  const BlockRun<Backlash> scene(swing, 1.0);
  const std::vector<double> times{0.1, 1.0, 0.5 * pi, 2.5, 4.0, 1.5 * pi, 5.5, 7.5};
  const Numbers y = scene.at(times), rate = scene.at(times, 1);
  const Numbers exact{0.0,  2.0 * std::sin(1.0) - 0.5, 1.5, 1.5, 2.0 * std::sin(4.0) + 0.5, -1.5,
                      -1.5, 2.0 * std::sin(7.5) - 0.5};
  for (std::size_t i = 0; i < y.size(); ++i) CHECK_THAT(y[i], WithinAbs(exact[i], rounding));
  CHECK(rate[3] == 0.0);
  CHECK_THAT(rate[4], WithinAbs(2.0 * std::cos(4.0), rounding));
}

TEST_CASE("the contacts of a Backlash are located", "[library][mechanics]") {
  const auto results = BlockRun<Backlash>(swing, 1.0).run(2.0 * pi);
  const auto at = [&](const char* event) { return results.events.times(text("block.", event)); };
  REQUIRE(at("drive_up").size() == 2);
  CHECK_THAT(at("drive_up")[0], WithinAbs(std::asin(0.25), rounding));
  CHECK_THAT(at("drive_up")[1], WithinAbs(2.0 * pi - pi / 6.0, rounding));
  REQUIRE(at("drive_down").size() == 1);
  CHECK_THAT(at("drive_down")[0], WithinAbs(pi - pi / 6.0, rounding));
  REQUIRE(at("turn").size() == 2);
  CHECK_THAT(at("turn")[0], WithinAbs(0.5 * pi, rounding));
}

/// A rate of 0 is no turn: y goes on with u. u - 1/4 is reached at 1/4, and the turn is at u = 2.
TEST_CASE("a Backlash whose input stops keeps its contact", "[library][mechanics]") {
  const BlockRun<Backlash> scene(stop_and_go, 0.5);
  const Numbers y = scene.at({0.2, 1.0, 1.5, 2.5, 3.0, 3.25, 4.0});
  const Numbers exact{0.0, 0.75, 0.75, 1.25, 1.75, 1.75, 1.25};
  for (std::size_t i = 0; i < y.size(); ++i) CHECK_THAT(y[i], WithinAbs(exact[i], rounding));
}

TEST_CASE("a Backlash may start in contact, on either side", "[library][mechanics]") {
  const BlockRun<Backlash> above(swing, 1.0, Backlash::Options{.initial_output = -2.0});
  const BlockRun<Backlash> below(swing, 1.0, Backlash::Options{.initial_output = 3.0});
  CHECK(above.at({0.0})[0] == -0.5);
  // u rises: it leaves at once, and rests eight roundings of |u| + width inside of the play.
  for (const double y : below.at({0.0, 0.4})) CHECK_THAT(y, WithinAbs(0.5, 8.0 * support::eps));
}

/// A load that moves with y: y(0) = 0, so it is where y is. The first half swing has a contact of
/// its own.
TEST_CASE("a Backlash misses no turn of a long run", "[library][mechanics]") {
  DiagramBuilder builder;
  auto& play = builder.add<Backlash>("block", 1.5);
  swing(builder, play);
  auto& load = builder.add<Integrator>("load");
  builder.connect(play.output(1), load.input());
  const Diagram diagram = builder.build();
  const Results results = simulate(diagram, diagram.create_context(), {0.0, 20.0 * pi}, precise());
  CHECK(events(results, "turn") == 20);
  CHECK(events(results, "drive_up") == 11);
  CHECK(events(results, "drive_down") == 10);
  // u = 0 on the way up, in contact. 60 pieces, each with an error of the solver.
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(-0.75, 60.0 * solver_tolerance));
}

/// Without the turn y would go back with u: the play would be lost without a word.
TEST_CASE("a Backlash refuses a rate that does not show the turn of its input",
          "[library][mechanics]") {
  const double rate = GENERATE(0.0, 1.0), side = GENERATE(1.0, -1.0);  // u = 2 sin t, and -2 sin t
  const auto wrong = [&](DiagramBuilder& builder, auto& block) {
    builder.connect(builder.add<Sine>("u", Sine::Options{.amplitude = 2.0 * side}).output(),
                    block.input(0));
    builder.connect(builder.add<Constant>("rate", rate * side).output(), block.input(1));
  };
  const BlockRun<Backlash> scene(wrong, 1.0);
  SimulatorOptions options = precise();
  options.throw_errors = false;
  const Results results = scene.run(8.0, options);
  INFO(results.message);
  CHECK(results.status == Status::failed);
  CHECK(contains(results.message, "block 'block': u drives y "));
  CHECK(contains(results.message, "in_rate is the rate of in, du/dt"));
  CHECK(contains(results.message, text("it is ", rate * side, " now")));
  // Back to u = 1/2 on the way down from 2, and on by a thousandth of the play.
  CHECK_THAT(results.context.time(), WithinAbs(pi - std::asin(0.2495), 1e-6));
}

/// The integral of y over a period: the loop is symmetrical.
TEST_CASE("a Backlash that reaches a derivative is exact there", "[library][mechanics]") {
  const double end = 4.0 * pi, start = 2.0 * pi;
  const double both = integral<Backlash>(end, swing, 1.0);
  CHECK_THAT(both - integral<Backlash>(start, swing, 1.0), WithinAbs(0.0, solver_tolerance));
}

/// v = 2 - t until it stops at 2 s, after 2 m; x does not creep afterwards, to the last bit.
TEST_CASE("a body with friction stops, and sticks", "[library][mechanics]") {
  const MassWithFriction::Options options{.initial_velocity = 2.0};
  const BlockRun<MassWithFriction> scene(fed_by<Constant>(0.0), options);
  const Numbers x = scene.at({1.0, 2.0, 50.0}), v = scene.at({1.0, 2.5, 50.0}, 1);
  CHECK_THAT(x[0], WithinAbs(1.5, rounding));
  CHECK_THAT(x[1], WithinAbs(2.0, rounding));
  CHECK(x[2] == x[1]);
  CHECK_THAT(v[0], WithinAbs(1.0, rounding));
  CHECK(v[1] == 0.0);
  CHECK(v[2] == 0.0);
}

/// It slips at the static friction, moves with the coulomb friction, and stops when it is left.
TEST_CASE("a body slips beyond the static friction only", "[library][mechanics]") {
  const MassWithFriction::Options options{.mass = 2.0, .coulomb = 1.0, .static_friction = 3.0};
  const auto after = [&](double force) {
    return BlockRun<MassWithFriction>(pushed(0.0, force, 0.0), options).at({1.5, 2.0, 9.0}, 1);
  };
  CHECK(after(2.9) == Numbers{0.0, 0.0, 0.0});
  CHECK(after(3.0) == Numbers{0.0, 0.0, 0.0});
  const Numbers v = after(5.0), back = after(-5.0);
  CHECK_THAT(v[0], WithinAbs(1.0, rounding));
  CHECK_THAT(v[1], WithinAbs(2.0, rounding));
  CHECK(v[2] == 0.0);
  for (std::size_t i = 0; i < 3; ++i) CHECK(back[i] == -v[i]);
}

/// A force at the friction, and then less: with equal frictions a body that slipped at the limit
/// would be driven backward by its own friction.
TEST_CASE("a body at the limit of its friction stays", "[library][mechanics]") {
  const BlockRun<MassWithFriction> held(pushed(1.0, 0.5, 0.0), MassWithFriction::Options{});
  CHECK(held.at({1.0, 2.0, 5.0}) == Numbers{0.0, 0.0, 0.0});
  CHECK(held.run(3.0).events.times("block.slip_up").empty());
}

/// The force falls under the friction while the body has moved for no time at all.
TEST_CASE("a body that slips for an instant sticks again", "[library][mechanics]") {
  const auto peak = fed_by<Sine>(Sine::Options{.amplitude = 1.0 + 1e-9});
  const BlockRun<MassWithFriction> scene(peak, MassWithFriction::Options{});
  const auto results = scene.run(6.0);
  const std::size_t slips = events(results, "slip_up") + events(results, "slip_down");
  CHECK(slips == events(results, "stick"));
  // It moves for sqrt(8e-9) s under a force below 1e-9 N, twice.
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.0, 1e-15));
}

/// The force is turned while the body moves: it stops, and slips to the other side at once.
TEST_CASE("a body that is pushed back turns without sticking", "[library][mechanics]") {
  const BlockRun<MassWithFriction> scene(pushed(3.0, -3.0, -3.0), MassWithFriction::Options{});
  // v = 2 t, then 2 - 4 (t - 1) to 0 at 1.5 s, then -2 (t - 1.5).
  const Numbers v = scene.at({1.0, 1.25, 2.0, 3.0}, 1);
  const Numbers exact{2.0, 1.0, -1.0, -3.0};
  for (std::size_t i = 0; i < v.size(); ++i) CHECK_THAT(v[i], WithinAbs(exact[i], rounding));
}

/// v' = 10 sin t - sign(v): what friction takes is what the force gives.
TEST_CASE("the work of friction is the loss of energy", "[library][mechanics]") {
  const MassWithFriction::Options options{.initial_velocity = 3.0};
  const Results results = BlockRun<MassWithFriction>(fed_by<Constant>(0.0), options).run(9.0);
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.5 * 3.0 * 3.0, rounding));
}

TEST_CASE("plays and frictions that are none are refused", "[library][mechanics]") {
  CHECK(
      contains(model_error([] { Backlash("b", 0.0); }), "width = 0; expected a finite number > 0"));
  const auto made = [](const MassWithFriction::Options& options) {
    return model_error([&] { MassWithFriction("m", options); });
  };
  CHECK(contains(made({.mass = 0.0}), "mass = 0 kg"));
  CHECK(contains(made({.coulomb = -1.0}), "coulomb = -1 N"));
  CHECK(contains(made({.viscous = -1.0}), "viscous = -1"));
  CHECK(contains(made({.coulomb = 2.0, .static_friction = 1.0}), "static friction 1 N is below"));
}
