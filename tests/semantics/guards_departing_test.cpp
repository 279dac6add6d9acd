// Semantics 2.5: a guard that has fired is at zero within its error. Another instant before it has clearly left
// zero does not make it fire again: the other instant says nothing about its side.
#include <cmath>
#include <limits>

#include "saltus/model/context_json.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two pucks on a line, masses 1, that collide once with restitution e.
struct Pucks {
  double left, right, v_left, v_right, e;
  double collides_at() const { return (right - left) / (v_left - v_right); }
};

const std::vector<Pucks> scenes{{2.6236805666423026, 6.107564816181483, 0.9, 0.2, 0.5},
                                {-1.5, 0.3, 0.7, -0.1, 1.0},
                                {0.1, 0.35, 1.3, 0.2, 0.5},
                                {5e3, 5e3 + 0.2, 0.07, 0.01, 0.8}};

std::shared_ptr<Leaf> pucks(const Pucks& scene) {
  return std::make_shared<Leaf>("pucks", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({scene.left, scene.right, scene.v_left, scene.v_right}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[2], at.x[3], 0.0, 0.0; }});
    l.declare_zero_crossing(
        {.name = "hit",
         .guard = [](const At& at) { return at.x[1] - at.x[0]; },
         .reset_map =
             [e = scene.e](const At& at, Next& next) {
               const double mean = 0.5 * (at.x[2] + at.x[3]), half = 0.5 * e * (at.x[2] - at.x[3]);
               next.set_continuous_state({at.x[0], at.x[1], mean - half, mean + half});
             },
         .direction = Direction::positive_then_non_positive});
  });
}

/// A leaf that has an instant at t: by a time event, or by the root of its own guard.
enum class Company { time_event, root };
std::shared_ptr<Leaf> company(Company kind, double t) {
  return std::make_shared<Leaf>("company", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    if (kind == Company::time_event) return l.declare_one_shot(t, count_up);
    l.declare_zero_crossing({.name = "level",
                             .guard = [=](const At& at) { return at.x[0] - t; },
                             .reset_map = count_up});
  });
}

/// Times [s] after the collision: each of the next roundings of the time, then powers of two of them, to a
/// hundredth of a second.
std::vector<double> delays(double t) {
  const double ulp = std::nextafter(t, 2.0 * t) - t;
  std::vector<double> all;
  for (int k = -4; k <= 24; ++k) all.push_back(k * ulp);
  for (double delay = 32.0 * ulp; delay < 1e-2; delay *= 4.0) all.push_back(delay);
  return all;
}

/// The pucks have collided once, and are as far apart as their speeds tell: within the error of the positions.
void check_apart(const Pucks& scene, const EventLog& events, const Context& end) {
  CHECK(events.times("hit").size() == 1);
  CHECK(events.times("hit", EventKind::zeno_enter).empty());
  const Eigen::VectorXd x = end.continuous_state();
  const double speed = scene.e * (scene.v_left - scene.v_right);
  const double gap = speed * (end.time() - scene.collides_at());
  CHECK(std::abs(x[3] - x[2] - speed) <= 1e-14);
  CHECK(std::abs(x[1] - x[0] - gap) <= 1e-13 * std::abs(scene.right) + 1e-12);
}

}  // namespace

TEST_CASE("2.5 a collision happens once, whatever instants of other blocks follow it",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto kind = GENERATE(Company::time_event, Company::root);
  for (const Pucks& scene : scenes) {
    const double hit = scene.collides_at();
    for (const double delay : delays(hit)) {
      INFO(method << ", hit at " << hit << " s, company " << delay << " s later");
      DiagramBuilder builder;
      const auto leaf = pucks(scene);
      builder.add(leaf);
      builder.add(company(kind, hit + delay));
      const Diagram diagram = builder.build();
      const Results results = simulate(diagram, diagram.create_context(), {0.0, 2.0 * hit},
                                       {.ode_solver_method = method});
      check_apart(scene, results.events, results.context[leaf->system_id()]);
    }
  }
}

TEST_CASE("5.6 a run cut a little after a collision has no second one", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Pucks& scene : scenes) {
    const double hit = scene.collides_at();
    const auto leaf = pucks(scene);
    for (const double delay : delays(hit)) {
      INFO(method << ", hit at " << hit << " s, cut " << delay << " s later");
      const SimulatorOptions options{.ode_solver_method = method};
      const Results first = simulate(*leaf, leaf->create_context(), {0.0, hit + delay}, options);
      const Results then = simulate(*leaf, context_from_json(*leaf, to_json(first.context)),
                                    {hit + delay, 2.0 * hit}, options);
      const auto before = first.events.times("hit").size();
      CHECK(before + then.events.times("hit").size() == 1);
      CHECK(then.context.continuous_state()[1] > then.context.continuous_state()[0]);
    }
  }
}
