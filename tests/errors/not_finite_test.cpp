// NaN and Inf from a derivative, a guard, an output or a reset map end the run and are named: which
// block, which t.

#include "saltus/library/library.hpp"
#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Ended {
  std::string message, printed, block;
  double time = not_a_number;
  bool partial = false;
};

/// Runs to t = 2 and reports how a SimulationError ended it.
Ended run(const System& system, Method method, SimulatorOptions options = {}) {
  Ended ended;
  options.ode_solver_method = method;
  ended.printed = printed_by([&] {
    try {
      simulate(system, system.create_context(), {0.0, 2.0}, options);
      ended.message = "no exception";
    } catch (const SimulationError& error) {
      ended.message = error.what(), ended.time = error.time(), ended.block = error.block();
      ended.partial = error.results() != nullptr;
    } catch (const std::exception& error) {
      ended.message = std::string("another exception: ") + error.what();
    }
  });
  return ended;
}

}  // namespace

TEST_CASE("a derivative that becomes NaN or Inf is named with its block and its time", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  const double bad = GENERATE(from_range(std::vector{not_a_number, infinite, -infinite}));
  INFO("method " << method << ", " << bad);
  DiagramBuilder builder;
  builder.add<Leaf>("good", [](Leaf& l) { declare_ramp(l); });
  builder.add<Leaf>("bad", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [=](const At& at) {
                                  return at.time > 1.0 ? bad : -at.x[0];
                                }});
  });
  const Diagram diagram = builder.build();
  const Ended ended = run(diagram, method);
  INFO(ended.message);
  CHECK(contains(ended.message, "derivative of block 'bad' is not finite (NaN or Inf)"));
  CHECK(contains(ended.message, std::isnan(bad) ? ": xdot[0] = nan where x = ["
                                : bad > 0.0     ? ": xdot[0] = inf where x = ["
                                                : ": xdot[0] = -inf where x = ["));
  CHECK(contains(ended.message, "check its equation and parameters"));
  CHECK(ended.block == "bad");
  CHECK(std::abs(ended.time - 1.0) < 1e-3);
  CHECK(ended.partial);
  CHECK(ended.printed == "");
}

TEST_CASE("no step to a state that is infinite is accepted, whatever its error estimate",
          "[errors]") {
  // x = 1e308 t is beyond the doubles from t = 1.797 on, with the same finite slope everywhere, so
  // the estimate is zero. The slopes of the others are as great as that, or change their sign, so
  // the squares in the estimate are infinite, and their quotient is NaN.
  const auto method = GENERATE(from_range(methods));
  const int kind = GENERATE(0, 1, 2);
  INFO("method " << method << ", kind " << kind);
  const Leaf leaf("large", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [kind](const At& at, VectorRef xdot) {
           const double slope = kind == 0 ? 1e308
                                : kind == 1
                                    ? 1.7e308 * at.time
                                    : (at.time > 1.0 ? 1e306 * std::exp(9.0 * at.time) : 1.0);
           xdot << slope, -slope;
         }});
  });
  SimulatorOptions options;
  options.ode_solver_method = method, options.throw_errors = false;
  const std::string printed = printed_by([&] {
    const auto results = simulate(leaf, leaf.create_context(), {0.0, 3.0}, options);
    CHECK(results.status == Status::failed);
    for (const double x : results.context.continuous_state()) CHECK(std::isfinite(x));
  });
  CHECK(printed == "");
}

TEST_CASE("a derivative that is NaN from the start is named at t0", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("root of minus one", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({-1.0}), .ode = [](const At& at) { return std::sqrt(at.x[0]); }});
  });
  const Ended ended = run(leaf, method);
  CHECK(contains(ended.message,
                 "t = 0 s: the derivative of block 'root of minus one' is not finite (NaN or Inf): "
                 "xdot[0] = nan where x = [-1]; check"));
  CHECK(ended.printed == "");
}

TEST_CASE("the entry that is not finite is named, and what the block sees", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto message_of = [&](Index n) {
    DiagramBuilder builder;
    const auto& level = builder.add<Constant>("level", -4.0);
    const auto& leaf = builder.add<Leaf>("leaf", [=](Leaf& l) {
      l.declare_input_port({.name = "u"});
      l.declare_continuous_state({.initial = Eigen::VectorXd::LinSpaced(n, 1.0, double(n)),
                                  .ode = [](const At& at, VectorRef xdot) {
                                    xdot.setZero();
                                    xdot[1] = std::sqrt(at.u(0));
                                  }});
    });
    builder.connect(level.output(), leaf.input());
    const Diagram diagram = builder.build();
    return run(diagram, method).message;
  };
  CHECK(contains(message_of(2), ": xdot[1] = nan where x = [1, 2], u = [-4]; check"));
  CHECK(contains(message_of(9), ": xdot[1] = nan where x[1] = 2, u = [-4]; check"));
}

TEST_CASE("an output that is not finite and that a derivative reads is named itself", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  const auto& x = builder.add<Integrator>("x", IntegratorOptions{.initial_state = -1.0});
  const auto& root = builder.add<Leaf>("root", [](Leaf& l) {
    l.declare_input_port({.name = "u"});
    l.declare_output_port(
        {.name = "y", .calc = [](const At& at, VectorRef y) { y[0] = std::sqrt(at.u(0)); }});
  });
  builder.connect(x.output(), root.input());
  builder.connect(root.output(), x.input());
  const Diagram diagram = builder.build();
  const Ended ended = run(diagram, method);
  CHECK(contains(ended.message,
                 "t = 0 s: output 'root.y', which a derivative reads, is not finite (NaN or Inf): "
                 "entry 0 is nan where u = [-1]; check"));
  CHECK(ended.block == "root");
}

TEST_CASE("a reset map that sets NaN is named with its event", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "jump",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({not_a_number}); }});
  });
  const Ended ended = run(leaf, method);
  INFO(ended.message);
  CHECK(contains(ended.message, "'leaf.jump' set a state that is not finite (NaN or Inf)"));
  CHECK(ended.block == "leaf");
  CHECK(std::abs(ended.time - 1.0) < 1e-9);
}

TEST_CASE("a guard that becomes NaN is an error, not an event", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [](const At& at) { return at.x[0] > 1.0 ? not_a_number : 5.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  const Ended ended = run(leaf, method);
  INFO(ended.message);
  CHECK(contains(ended.message, "'leaf.level'"));
  CHECK(contains(ended.message, "not finite"));
  CHECK(ended.block == "leaf");
}
