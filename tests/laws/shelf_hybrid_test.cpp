// The hybrid scenes of the shelf: the law that each keeps with each method that suits it, and the
// closed forms behind it against the equations, integrated in 30 digits (shelf_references.py).
#include <saltus/models/models.hpp>
#include <saltus/report/achieved.hpp>

#include "support/run.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinRel;

namespace {

/// What an error of one tolerance does to the times of events: `size` of the state that decides
/// them, `seconds` per unit of it, and in how many of the pieces before an event it is made.
struct Timing {
  std::string name;
  double size, seconds, pieces;
};

const std::vector<Timing> timings{
    {"bouncing-ball", 14.0, 2.0 / 9.81, 6.0},          // a flight is 2 v / g long; six of them
    {"bouncing-ball-blocks", 0.14, 2.0 / 9.81, 25.0},  // 1 / (1 - e) flights' worth of later ones
    {"ball-drag", 12.0, 2.0 / 9.81, 25.0},             // the same, and of errors
    {"ball-table", 1.0, 1.0 / 3.0, 12.0 * 7.2},        // 3 m/s to the table; growth of times
    {"two-walls", 1.0, 1.0, 100.0},                    // 1 m/s
    {"newtons-cradle", 0.1, 1.0 / 0.5, 13.0},          // 0.5 m/s towards each other
    {"water-tanks", 1.0, 1.0 / 0.25, 10.0},            // accumulate at 0.25 m^3/s
    {"thermostat", 21.0, 1800.0 / 9.0, 160.0},         // tau over 9 degrees, the slower rate
    {"integrate-and-fire", 15.0, 1.0 / 186.0, 17 * 2.4},  // 186 mV/s at the slowest spike
    {"stick-slip", 1.0, 1.0 / 0.1, 9.0},                  // the belt's speed
    {"rimless-wheel", 0.4, 10.0, 11.0},                   // lost at the top, see its growth
    {"buck-converter", 12.0, 8.4 * 4e-4 / 4.4, 51.0},     // the ramp's rate over the loop's gain
    {"rocking-block", 0.3, 2.0 / (4.0 * 0.2), 100.0},     // 2 / (p^2 alpha); 1 / (1 - r) twice
    // w = 3.2e4 turns an error of y in contact, of 1e-6 m at most, into one of speed, in 2
    // contacts.
    {"stiff-contact", 1e-6, 3.2e4 * 2.0 / 9.81, 2.0},
    {"buck-parasitics", 20.0, 1e-8, 10.0},          // the node falls at 1e8 V/s, ten times
    {"relay-circuit", 4.0, 1.0 / 3.0, 49.0 * 1.5},  // 3 V/s at the slower switch
};

double penetration(const saltus::Scene& scene, const Results& results) {
  double deepest = 0.0;
  for (std::size_t row = 0; scene.gap && row < results.time.size(); ++row)
    deepest = std::max(deepest, -scene.gap(results.time[row], detail::row_of(results, row)));
  return deepest;
}

}  // namespace

TEST_CASE("each hybrid scene of the shelf meets its answer with each method that suits it",
          "[laws][shelf]") {
  const Timing timing = GENERATE(from_range(timings));
  const double rtol = GENERATE(1e-5, 1e-6, 1e-9);
  const saltus::Scene scene = models::scene(timing.name);
  for (const Method method : scene.methods) {
    INFO(timing.name << " by " << method << " at rtol " << rtol);
    const saltus::Scene run = at_tolerance(scene, method, rtol);
    const Results results = simulate(run);
    const Achieved a = achieved(run, results);
    CHECK(results.status == Status::reached_end);
    CHECK(a.event_mismatch == 0);
    CHECK(a.scaled <= 10.0 * scene.growth);
    // Ten tolerances of what decides an event, and rounding: 100 eps (t + h) where it is looked
    // for, carried on from piece to piece.
    const double tolerance = run.options.atol + rtol * timing.size,
                 rounding = 200.0 * eps * scene.span.end,
                 allowed = timing.pieces * (10.0 * tolerance * timing.seconds + rounding);
    CHECK(a.event_error <= allowed);
    if (!std::isnan(a.accumulation_error)) CHECK(a.accumulation_error <= allowed);
    if (!std::isnan(a.release_error)) CHECK(a.release_error == 0.0);
    // An event is located far better than the state is known: no surface is passed by a tolerance.
    CHECK(penetration(scene, results) <= tolerance);
  }
}

TEST_CASE("what no event changes of a hybrid scene stays as it was", "[laws][shelf]") {
  struct Kept {
    saltus::Scene scene;
    double size;  // largest |d value / d state|, with the weights of the state
  };
  // Energies: v dv per unit of mass. Each impact adds an error of ten tolerances at most.
  const std::vector<Kept> all{{models::bouncing_ball({.e = 1.0}), 14.0},
                              {models::two_walls(), 1.0},
                              {models::newtons_cradle(), 0.5 + 25.0 * 0.1}};
  for (const auto& [scene, size] : all) {
    REQUIRE(scene.invariants.size() == 1);
    for (const Method method : scene.methods) {
      INFO(scene.name << " by " << method);
      const saltus::Scene run = at_tolerance(scene, method, 1e-9);
      const Results results = simulate(run);
      const auto value = [&](std::size_t row) {
        return scene.invariants[0].value(results.time[row], detail::row_of(results, row));
      };
      double drift = 0.0;
      for (std::size_t row = 1; row < results.time.size(); ++row)
        drift = std::max(drift, std::abs(value(row) - value(0)));
      const double events = static_cast<double>(results.events.size());
      CHECK(drift <= 10.0 * events * size * (run.options.atol + 1e-9 * size));
    }
  }
}

TEST_CASE("the closed forms of the shelf agree with the equations integrated in 30 digits",
          "[laws][shelf]") {
  struct Reference {
    std::string name;
    std::size_t event;  // counted from 1; where the state is that behind it
    double time;
    std::vector<double> state;
  };
  const std::vector<Reference> references{
      {"ball-drag", 5, 5.9467598186348386, {0.0, 2.6232084977465192}},
      {"ball-table", 12, 7.6257700591859369, {0.037875058645481481, 3.0599911659203579}},
      {"integrate-and-fire", 16, 0.91053334566565119, {0.0}},
      {"stick-slip", 9, 56.526199919374086, {1.0, 0.1}},
      {"rocking-block", 8, 6.776414950466512, {0.0, 0.16671923354183712}},
      {"buck-converter", 51, 0.010160819852853293, {0.49502953880711978, 11.962978378736455}},
      {"stiff-contact", 5, 0.019763998904297947, {0.0, -0.0032893237397450768}},
      {"newtons-cradle",
       8,
       0.96047689815984465,
       {-0.00099680207839537737, -0.00099680207839537737, 2.4985638008148002e-6,
        0.0010019988611758721, 0.0020016989535950978, -0.49957527912968687, 0.00039955026300379262,
        0.00039965522567436777, 0.00039973019758588787, 0.00039977518373024583}},
  };
  for (const auto& [name, event, time, state] : references) {
    INFO(name);
    const Exact exact = models::scene(name).exact;
    CHECK_THAT(exact.events[0].series[0].times[event - 1], WithinRel(time, 4.0 * eps));
    const Eigen::VectorXd found = exact.state(time, {0, event, false});
    // The time is rounded to a double: the state is off by its rate of change times that.
    const Eigen::VectorXd later = exact.state(time * (1.0 + 4.0 * eps), {0, event, false});
    for (std::size_t i = 0; i < state.size(); ++i) {
      const auto k = static_cast<Index>(i);
      CHECK(std::abs(found[k] - state[i]) <=
            4.0 * eps * std::abs(state[i]) + 2.0 * std::abs(later[k] - found[k]));
    }
  }
}
