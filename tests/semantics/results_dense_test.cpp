// Semantics 5.8: dense output is asked for any time within a run.
#include "support/balls.hpp"
#include "support/circle.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

TEST_CASE("5.8 dense output is what the solver itself interpolates", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto times = inner_times(0.0, 10.0, 997);
  // A polynomial of degree 12 at most, rebuilt from its values at Chebyshev points: a few
  // roundings.
  const double rounding = 50.0 * eps;
  const auto rows =
      run_circle({.rtol = 1e-7, .atol = 1e-9, .ode_solver_method = method, .save_at = times});
  const auto dense =
      run_circle({.rtol = 1e-7, .atol = 1e-9, .ode_solver_method = method, .dense_output = true});
  const auto x = rows.output("x"), square = rows.output("square");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Moment moment = dense.at(times[i]);
    const auto row = static_cast<Index>(i) + 1;  // row 0 is the start
    CHECK(rows.time[i + 1] == times[i]);
    CHECK_THAT(moment.output("x")[0], WithinAbs(x(row, 0), rounding));
    CHECK_THAT(moment.continuous_state[1], WithinAbs(x(row, 1), rounding));
    CHECK_THAT(moment.output("square")[0], WithinAbs(square(row, 0), 11.0 * rounding));
  }
}

TEST_CASE("5.8 at the times of rows dense output has the bits of the rows", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.7})) {
    INFO(scene.form << ", method " << method);
    const auto results = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 1.2},
                                  {.ode_solver_method = method,
                                   .recorded_signals = {{"y", scene.height}},
                                   .dense_output = true});
    const auto y = results.output("y");
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      const double t = results.time[i];
      const auto rows = rows_at(results, t);
      const bool first = i == rows.front(), last = i == rows.back();
      for (Index k = 0; k < y.cols(); ++k) {
        if (first) CHECK(results.at(t, Side::left).output("y")[k] == y(static_cast<Index>(i), k));
        if (last) CHECK(results.at(t).output("y")[k] == y(static_cast<Index>(i), k));
      }
    }
  }
}

TEST_CASE("5.8 held signals and modes are those of the time asked for", "[semantics]") {
  const auto leaf = make_leaf("stairs", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_default_mode(1);
    l.declare_discrete_state_output("z");
    l.declare_mode_output("mode");
    l.declare_output_port(
        {.name = "product", .calc = [](const At& at) { return at.x[0] * at.z[0] * at.mode; }});
    l.declare_periodic_update(
        [](const At& at, Next& next) {
          next.set_discrete_state({at.z[0] + 1.0});
          next.set_mode(at.mode + 1);
        },
        1.0, 1.0);
  });
  for (const Form& form : forms(leaf)) {
    INFO(form.name);
    const LeafSystem& of = *leaf;
    const auto results = simulate(
        *form.system, form.context(), {0.0, 3.5},
        {.recorded_signals = {{"z", of.output(1)}, {"mode", of.output(2)}, {"p", of.output(3)}},
         .dense_output = true});
    CHECK(results.at(0.5).output("z")[0] == 0.0);
    CHECK(results.at(2.0, Side::left).output("z")[0] == 1.0);
    CHECK(results.at(2.0).output("z")[0] == 2.0);
    CHECK(results.at(2.5).output("mode")[0] == 3.0);
    CHECK_THAT(results.at(2.5).output("p")[0], WithinAbs(2.5 * 2.0 * 3.0, 1e-13));
    CHECK_THAT(results.at(0.5).output("p")[0], WithinAbs(0.0, 0.0));
  }
}

TEST_CASE("5.8 nothing is extrapolated, and nothing is kept unasked", "[semantics]") {
  const auto results = run_circle({.dense_output = true});
  for (const double t : {-0.1, 10.1, not_a_number})
    CHECK(contains(message<ModelError>([&] { results.at(t); }), "is outside the run, which went"));
  CHECK(contains(message<ModelError>([&] { results.at(-0.1); }),
                 "t = -0.1 s is outside the run, which went from 0 s to 10 s"));
  CHECK(contains(message<ModelError>([&] { results.at(1.0).output("y"); }),
                 "nothing was recorded under 'y'"));
  const auto plain = run_circle({});
  CHECK(plain.trajectory.empty());
  CHECK(plain.trajectory.memory() == 0);
  CHECK(contains(message<ModelError>([&] { plain.at(1.0); }), "dense_output"));
}

TEST_CASE("5.8 dense output changes no bit of a run, and costs nothing unasked", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Ball ball({.e = 0.8});
  const auto context = ball.create_context().with_continuous_state({1.0, 0.0});
  SimulatorOptions options{.ode_solver_method = method,
                           .recorded_signals = {{"state", ball.output(0)}}};
  const auto plain = simulate(ball, context, {0.0, 6.0}, options);
  options.dense_output = true;
  const auto dense = simulate(ball, context, {0.0, 6.0}, options);
  CHECK(dense.time == plain.time);
  CHECK(dense.output("state") == plain.output("state"));
  CHECK(same_bits(dense.events, plain.events));
  CHECK(same_bits(dense.context, plain.context));
  CHECK(dense.statistics.steps == plain.statistics.steps);
  CHECK(dense.statistics.guard_calls == plain.statistics.guard_calls);
  // DOP853 alone needs more of the right-hand side for it: three stages a step, and only if asked.
  // "auto" takes DOPRI5 at this tolerance.
  const std::int64_t more =
      dense.statistics.right_hand_side_calls - plain.statistics.right_hand_side_calls;
  if (method == Method::dop853)
    CHECK(more <= 3 * dense.statistics.steps);
  else
    CHECK(more == 0);
}
