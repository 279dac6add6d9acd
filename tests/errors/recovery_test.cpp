// After any error the same system and the same simulator run as if nothing had been, and what was
// computed until then is there.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

enum class Where { nowhere, ode, guard, reset, update, output };

/// x' = -x from 1, back to 1 at 1/2, a tick each 0.25 s; after t = 0.6 one of its functions gives
/// `bad`, or throws.
struct Fragile {
  Where where = Where::nowhere;
  double bad = not_a_number;
  bool throws = false;

  double trouble(Where here, double t) const {
    if (here != where || !(t > 0.6)) return 0.0;
    return throws ? throw std::domain_error("mine") : bad;
  }
  Leaf leaf() const {
    return {
        "fragile", [this](Leaf& l) {
          l.declare_continuous_state({.initial = vec({1.0}), .ode = [this](const At& at) {
                                        return -at.x[0] + trouble(Where::ode, at.time);
                                      }});
          l.declare_discrete_state(vec({0.0}));
          l.declare_output_port({.name = "y", .calc = [this](const At& at) {
                                   return at.x[0] + trouble(Where::output, at.time);
                                 }});
          l.declare_zero_crossing(
              {.name = "half",
               .guard =
                   [this](const At& at) { return at.x[0] - 0.5 + trouble(Where::guard, at.time); },
               .reset_map =
                   [this](const At& at, Next& next) {
                     next.set_continuous_state({1.0 + trouble(Where::reset, at.time)});
                   }});
          l.declare_periodic_update(
              [this](const At& at, Next& next) {
                next.set_discrete_state({at.z[0] + 1.0 + trouble(Where::update, at.time)});
              },
              0.25, 0.0, "tick");
        }};
  }
};

}  // namespace

TEST_CASE("after an error from any function the simulator runs as if nothing had been",
          "[errors]") {
  const auto method = GENERATE(from_range(methods));
  const Where where =
      GENERATE(Where::ode, Where::guard, Where::reset, Where::update, Where::output);
  const bool throws = GENERATE(false, true);
  INFO("method " << method << ", function " << static_cast<int>(where) << ", throws " << throws);
  Fragile fragile{.where = where, .throws = throws};
  const Leaf leaf = fragile.leaf();
  const SimulatorOptions options{.ode_solver_method = method,
                                 .recorded_signals = {{"y", leaf.output()}},
                                 .throw_errors = false};
  Simulator simulator(leaf, options);
  simulator.initialize(leaf.create_context());
  CHECK(simulator.advance_to(2.0) == Status::failed);

  const Results& kept = simulator.results();
  CHECK(kept.message.size() > 0);
  CHECK(kept.time.front() == 0.0);
  CHECK(kept.time.back() >= 0.5);
  CHECK(kept.time.back() <= kept.context.time());
  CHECK(std::abs(kept.context.time() - 0.6) < 0.2);
  CHECK(std::isfinite(kept.context.continuous_state()[0]));
  CHECK(count(kept.events, EventKind::time) == kept.context.discrete_state()[0]);
  CHECK(count(kept.events, EventKind::time) >= 3);

  fragile.where = Where::nowhere;
  simulator.initialize(leaf.create_context());
  CHECK(simulator.advance_to(2.0) == Status::reached_end);
  const Results good = simulate(leaf, leaf.create_context(), {0.0, 2.0}, options);
  CHECK(same_bits(simulator.results().events, good.events));
  CHECK(same_bits(simulator.context(), good.context));
  CHECK(column(simulator.results(), "y") == column(good, "y"));
}

TEST_CASE("an update that sets NaN is named with its event", "[errors]") {
  const Fragile fragile{.where = Where::update};
  const Leaf leaf = fragile.leaf();
  CHECK(message<SimulationError>([&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}); }) ==
        "t = 0.75 s: 'fragile.tick' set a state that is not finite (NaN or Inf)");
}

TEST_CASE("an interrupt that throws ends the run, and the next one goes well", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  const Fragile fragile;
  const Leaf leaf = fragile.leaf();
  SimulatorOptions options{.ode_solver_method = method, .record_events = false};
  options.interrupt = []() -> bool { throw std::domain_error("mine"); };
  CHECK(message<std::domain_error>(
            [&] { simulate(leaf, leaf.create_context(), {0.0, 1e9}, options); }) == "mine");
  options.interrupt = {};
  CHECK(simulate(leaf, leaf.create_context(), {0.0, 2.0}, options).status == Status::reached_end);
}
