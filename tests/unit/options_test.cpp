// Options: each value that makes no sense is refused by name; the defaults are fine.
#include "saltus/solver/detail/choose.hpp"
#include "support/balls.hpp"

using namespace saltus;
using namespace support;

namespace {

std::string refused(const SimulatorOptions& options) {
  const Ball ball;
  return message<ModelError>([&] { Simulator(ball, options); });
}

}  // namespace

TEST_CASE("the defaults are accepted", "[options]") {
  CHECK(refused({}) == "no exception");
  CHECK(refused({.event_scan_points = 0, .max_passes = 1}) == "no exception");
  CHECK(refused({.zeno_tolerance = 0.0}) == "no exception");
}

TEST_CASE("tolerances that are not positive, or finer than a double, are refused", "[options]") {
  for (const double bad : {0.0, -1e-6, not_a_number, infinite}) {
    INFO(bad);
    CHECK(contains(refused({.rtol = bad}), "option rtol: expected a positive number, found "));
    CHECK(contains(refused({.atol = bad}), "option atol: expected a positive number, found "));
  }
  CHECK(refused({.rtol = 1e-16}) ==
        "option rtol: expected at least 1e-15: a double has no more digits, found 1e-16");
}

TEST_CASE("step bounds that make no sense are refused", "[options]") {
  CHECK(refused({.max_major_steps = 0}) ==
        "option max_major_steps: expected a positive number, or none, found 0");
  CHECK(refused({.max_major_steps = -5}) ==
        "option max_major_steps: expected a positive number, or none, found -5");
  CHECK(refused({.max_major_step_length = 0.0}) ==
        "option max_major_step_length: expected a time > 0 s, found 0");
  CHECK(contains(refused({.max_major_step_length = not_a_number}), "option max_major_step_length"));
  CHECK(refused({.min_minor_step_size = -1.0}) ==
        "option min_minor_step_size: expected a time >= 0 s, found -1");
  CHECK(refused({.max_minor_step_size = 0.0}) ==
        "option max_minor_step_size: expected more than min_minor_step_size, found 0");
  CHECK(contains(refused({.min_minor_step_size = 0.2, .max_minor_step_size = 0.1}),
                 "more than min_minor_step_size, found 0.1"));
}

TEST_CASE("event options that make no sense are refused", "[options]") {
  CHECK(refused({.zeno_tolerance = -1.0}) ==
        "option zeno_tolerance: expected a time >= 0 s, found -1");
  CHECK(contains(refused({.zeno_tolerance = not_a_number}), "option zeno_tolerance"));
  CHECK(refused({.event_scan_points = -1}) ==
        "option event_scan_points: expected 0 or more, found -1");
  CHECK(refused({.max_passes = 0}) == "option max_passes: expected 1 or more, found 0");
}

TEST_CASE("times to record at have to increase and be finite", "[options]") {
  CHECK(refused({.save_at = {1.0, 1.0}}) == "option save_at: expected increasing times, found 1");
  CHECK(contains(refused({.save_at = {1.0, 0.5}}), "increasing times, found 0.5"));
  CHECK(contains(refused({.save_at = {1.0, not_a_number}}), "increasing times, found nan"));
  CHECK(refused({.save_at = {1.0, 2.0, 3.0}}) == "no exception");
}

TEST_CASE("a method has synonyms", "[options]") {
  CHECK(method_from("rk45") == Method::dopri5);
  CHECK(method_from("non-stiff") == Method::dopri5);
  CHECK(method_from("stiff") == Method::bdf);
  CHECK(method_from("BDF") == Method::bdf);
  CHECK(method_from("auto") == Method::automatic);
  CHECK(method_from("DOP853") == Method::dop853);
  CHECK(method_from("RK45") == Method::dopri5);
  CHECK(contains(message<ModelError>([] { method_from("DOPRI5"); }),
                 "unknown ode_solver_method 'DOPRI5'"));
}

TEST_CASE("methods and linear solvers are written by the name they are read by", "[options]") {
  for (const Method method : methods) CHECK(method_from(to_string(method)) == method);
  for (const auto& [name, solver] : linear_solver_names) {
    CHECK(to_string(solver) == name);
    CHECK(linear_solver_from(name) == solver);
  }
}
