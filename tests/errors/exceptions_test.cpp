// What a user's function throws comes out as it was, from every callback, by every method; nothing
// is printed.
#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Not derived from std::runtime_error, and with a number inside: it has to arrive whole.
struct Spilled : std::exception {
  explicit Spilled(int n) : cups(n) {}
  const char* what() const noexcept override { return "milk was spilled"; }
  int cups;
};

enum class Where { ode, guard, reset, output, update, relation, shown, jacobian };

/// A scene that throws in one of its functions, at t = 0.5 or soon after.
std::shared_ptr<const System> scene(Where where) {
  const auto spill = [where](Where here, double t) {
    if (here == where && t > 0.5) throw Spilled(3);
  };
  return std::make_shared<Leaf>("kitchen", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [=](const At& at) {
                                  return spill(Where::ode, at.time), -at.x[0];
                                }});
    l.declare_jacobian(
        [=](const At& at, MatrixRef j) { spill(Where::jacobian, at.time + 1.0), j(0, 0) = -1.0; });
    l.declare_discrete_state(vec({0.0}));
    l.declare_output_port({.name = "shown", .calc = [=](const At& at) {
                             return spill(Where::shown, at.time), at.x[0];
                           }});
    l.declare_relation({.name = "relation", .guard = [=](const At& at) {
                          return spill(Where::relation, at.time), at.x[0] - 2.0;
                        }});
    l.declare_zero_crossing(
        {.name = "guard",
         .guard = [=](const At& at) { return spill(Where::guard, at.time), at.time - 0.7; },
         .reset_map =
             [=](const At& at, Next& next) {
               spill(Where::reset, at.time), next.set_discrete_state({1.0});
             }});
    l.declare_periodic_update(
        [=](const At& at, Next& next) {
          spill(Where::update, at.time), next.set_discrete_state({2.0});
        },
        0.3);
  });
}

}  // namespace

TEST_CASE("an exception from any callback comes out as it was thrown, by any method", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  const Where where = GENERATE(Where::ode, Where::guard, Where::reset, Where::update,
                               Where::relation, Where::shown);
  INFO("method " << method << ", function " << static_cast<int>(where));
  const auto system = scene(where);
  int cups = 0;
  const std::string printed = printed_by([&] {
    try {
      simulate(
          *system, system->create_context(), {0.0, 2.0},
          {.ode_solver_method = method, .recorded_signals = {{"shown", system->output("shown")}}});
    } catch (const Spilled& spilled) {
      cups = spilled.cups;
    } catch (...) {
      cups = -1;
    }
  });
  CHECK(cups == 3);
  CHECK(printed == "");
}

TEST_CASE("an exception from a Jacobian comes out of a stiff method as it was thrown", "[errors]") {
  const auto system = scene(Where::jacobian);
  const auto method = GENERATE(Method::bdf, Method::radau);
  CHECK_THROWS_AS(
      simulate(*system, system->create_context(), {0.0, 2.0}, {.ode_solver_method = method}),
      Spilled);
  CHECK_NOTHROW(simulate(*system, system->create_context(), {0.0, 2.0},
                         {.ode_solver_method = Method::adams}));
}

TEST_CASE("with throw_errors off the cause and the partial results are in what is returned",
          "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto system = scene(Where::ode);
  const auto results = simulate(*system, system->create_context(), {0.0, 2.0},
                                {.ode_solver_method = method,
                                 .recorded_signals = {{"shown", system->output("shown")}},
                                 .throw_errors = false});
  CHECK(results.status == Status::failed);
  CHECK(results.message == "milk was spilled");
  REQUIRE(results.cause);
  CHECK_THROWS_AS(std::rethrow_exception(results.cause), Spilled);
  CHECK(results.time.size() >= 2);
  CHECK(results.context.time() <= 0.6);
}

TEST_CASE("what is thrown need not be an exception", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                  return at.time > 0.5 ? throw 42 : 1.0;
                                }});
  });
  int caught = 0;
  try {
    simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  } catch (int n) {
    caught = n;
  }
  CHECK(caught == 42);
}

TEST_CASE("after an exception the simulator can be initialized again", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  bool angry = true;
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [&](const At& at) {
                                  return angry && at.time > 0.5 ? throw Spilled(1) : -at.x[0];
                                }});
  });
  Simulator simulator(leaf, {.ode_solver_method = method});
  simulator.initialize(leaf.create_context());
  CHECK_THROWS_AS(simulator.advance_to(2.0), Spilled);
  angry = false;
  simulator.initialize(leaf.create_context());
  CHECK(simulator.advance_to(2.0) == Status::reached_end);
  CHECK(std::abs(simulator.context().continuous_state()[0] - std::exp(-2.0)) < 1e-4);
}
