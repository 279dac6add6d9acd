// Balls: gravity and height over 15 decades, restitution next to one, to rest and beyond.
#pragma once

#include <saltus/models/bouncing_ball_diagram.hpp>

#include "extremes/scenes.hpp"

namespace extremes {

namespace detail {

/// The law: on the floor at twice the Zeno time, and the times of the first four contacts. The unit
/// of height: 4 (rtol y0 + atol), the sum over the flights for e <= 1/2, and a tenth of the height
/// that a flight as long as the Zeno tolerance may hide. A speed counts as the height it reaches.
/// The unit of a contact's time: an impact wrong by rtol makes flights wrong by 2 rtol v / g.
inline Law rests(const Ball& ball) {
  return [ball](const Results& results, const SimulatorOptions& with) {
    const Eigen::VectorXd& x = results.context.continuous_state();
    const double hidden = 0.1 * ball.g * with.zeno_tolerance * with.zeno_tolerance;
    const double unit = 4.0 * (with.rtol * ball.y0 + with.atol) + hidden;
    std::vector<double> found = firing_times(results.events);
    found.erase(std::unique(found.begin(), found.end()), found.end());  // two integrators: twice
    const std::vector<double> exact = ball.contacts(2.8 * ball.first());
    Finding finding{.error = std::max(std::abs(x[0]) / unit, x[1] * x[1] / (2.0 * ball.g * unit)),
                    .allowed = allowed(with.ode_solver_method),
                    .events = text(std::min(found.size(), exact.size()), " of ", exact.size()),
                    .events_right = found.size() >= exact.size()};
    for (std::size_t i = 0; i < std::min(found.size(), exact.size()); ++i) {
      const double tolerance = with.rtol + with.atol / ball.speed() + with.atol / ball.y0;
      finding.error =
          std::max(finding.error, std::abs(found[i] - exact[i]) / (8.0 * tolerance * ball.first()));
    }
    return finding;
  };
}

inline Trial to_rest(const Ball& ball, bool of_blocks) {
  const SimulatorOptions options{.rtol = 1e-9,
                                 .atol = 1e-9 * std::min(ball.y0, ball.speed()),
                                 .zeno_tolerance = 1e-6 * ball.first()};
  const TimeSpan span{0.0, 2.0 * ball.rest()};
  if (!of_blocks) return trial(ball.leaf(), span, options, rests(ball));
  const auto diagram = std::make_shared<const saltus::Diagram>(
      saltus::models::make_bouncing_ball_diagram({.g = ball.g,
                                                  .e = ball.e,
                                                  .y0 = ball.y0,
                                                  .dropped = 0.0,
                                                  .drop_time = 4.0 * ball.rest()}));
  const System& y = (*diagram)["integrator_y"];
  const System& v = (*diagram)["integrator_v"];
  const Law law = rests(ball);
  const auto in_order = [law, id_y = y.system_id(), id_v = v.system_id()](
                            const Results& results, const SimulatorOptions& with) {
    Results turned = results;  // integrator_v was added first
    const Context& context = results.context;
    turned.context = context.with_continuous_state(
        vec({context[id_y].continuous_state()[0], context[id_v].continuous_state()[0]}));
    return law(turned, with);
  };
  Trial made = trial(diagram, span, options, in_order);
  made.start = made.start.with_subcontext(
      y.system_id(), made.start[y.system_id()].with_continuous_state(vec({ball.y0})));
  return made;
}

/// g and y0 in 15 decades each, every second power of ten.
inline Case grid(double e, bool of_blocks, Methods methods) {
  return {.name = text("ball ", of_blocks ? "of blocks" : "as a leaf", ", e = ", e,
                       ", to rest: g = 1e-7 to 1e7, y0 = 1e-7 to 1e7 (64 runs)"),
          .methods = std::move(methods),
          .trials = [=] {
            std::vector<Trial> all;
            for (int g = -7; g <= 7; g += 2)
              for (int y = -7; y <= 7; y += 2)
                all.push_back(to_rest({std::pow(10.0, g), e, std::pow(10.0, y)}, of_blocks));
            return all;
          }};
}

/// A ball that loses a billionth of its speed: it must neither rest nor gain energy. An impact
/// wrong by one tolerance delays all later ones: n of them add up as n^2.
inline Case hardly_damped(double y0, int contacts) {
  const Ball ball{9.81, 1.0 - 1e-9, y0};
  return {.name = text("ball, e = 1 - 1e-9, y0 = ", y0, " m, ", contacts, " contacts"),
          .methods = every,
          .trials = one([=] {
            const double in_time = std::min(ball.y0, ball.speed());
            return contacts_of(ball, contacts, {.rtol = 1e-9, .atol = 1e-10 * in_time});
          })};
}

}  // namespace detail

inline Group balls() {
  using namespace detail;
  Group group{.title = "Balls over 15 decades",
              .text =
                  "The run goes on to twice the Zeno time: height and speed have to be those of "
                  "a ball at rest, and the first four contacts (e = 0: one) in time.",
              .cases = {}};
  for (const double e : {0.0, 0.5}) {
    group.cases.push_back(grid(e, false, every));
    group.cases.push_back(grid(e, true, every));
  }
  group.cases.push_back(hardly_damped(1.0, 1000));
  group.cases.push_back(hardly_damped(1e-9, 1000));
  return group;
}

}  // namespace extremes
