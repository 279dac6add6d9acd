// std::cout << results: what the lines say, and which are left out.
#include <sstream>

#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

std::string shown(const Results& results) {
  std::ostringstream out;
  out << results;
  return out.str();
}

Results ball_run(const SimulatorOptions& options) {
  const Ball ball(BallOptions{.e = 0.5}, "ball");
  return simulate(ball, ball.create_context().with_continuous_state(vec({10.0, 0.0})), {0.0, 6.0},
                  options);
}

}  // namespace

TEST_CASE("a run is shown with its status, events, rest and counts", "[unit]") {
  const std::string text = shown(ball_run({.ode_solver_method = Method::dopri5}));
  CHECK(text.starts_with("<Results: reached_end, "));
  CHECK(text.ends_with(">"));
  for (const std::string part : {"0 rows, t = 6 s", "\n  outputs       nothing recorded",
                                 " events: ball.bounce ", "\n  at rest       ball from ",
                                 "steps of dopri5, ", " right-hand side, ", "\n  took          "})
    CHECK(contains(text, part));
  CHECK(!contains(text, "dense output"));
  CHECK(!contains(text, "why"));
}

TEST_CASE("a run that ends badly is shown with its reason", "[unit]") {
  const std::string text = shown(ball_run({.max_major_steps = 1, .throw_errors = false}));
  CHECK(text.starts_with("<Results: step_limit, "));
  CHECK(contains(text, "\n  why           "));
}

TEST_CASE("a run with dense output is shown with its span", "[unit]") {
  const std::string text = shown(ball_run({.dense_output = true}));
  CHECK(contains(text, "dense output  at any time from 0 to 6 s>"));
}
