// Semantics 6.6: one caller at a time; a structure in use cannot be declared on.
#include <functional>
#include <future>
#include <thread>

#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = -x; it calls `inside` once, at the first call of its derivative after t = 0.3.
struct Calling {
  std::function<void()> inside = {};
  bool called = false;

  Leaf leaf() {
    return {"leaf", [this](Leaf& l) {
              l.declare_continuous_state({.initial = vec({1.0}), .ode = [this](const At& at) {
                                            if (at.time > 0.3 && inside && !called) {
                                              called = true;
                                              inside();
                                            }
                                            return -at.x[0];
                                          }});
              l.declare_continuous_state_output("x");
            }};
  }
};

/// Each further call, by name.
const std::vector<std::pair<std::string, std::function<void(Simulator&, const Context&)>>> calls{
    {"initialize", [](Simulator& s, const Context& start) { s.initialize(start); }},
    {"advance_to", [](Simulator& s, const Context&) { s.advance_to(1.0); }},
    {"context", [](Simulator& s, const Context&) { s.context(); }},
    {"take_results", [](Simulator& s, const Context&) { s.take_results(); }},
    {"describe", [](Simulator& s, const Context&) { s.describe(); }}};

}  // namespace

TEST_CASE("6.6 a call from a callback of the run is an error and changes nothing", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const auto& [name, call] : calls) {
    INFO("method " << method << ", " << name);
    Calling calling;
    const Leaf leaf = calling.leaf();
    const SimulatorOptions options{.ode_solver_method = method,
                                   .recorded_signals = {{"x", leaf.output()}}};
    const Context start = leaf.create_context();
    const Results plain = simulate(leaf, start, {0.0, 1.0}, options);

    Simulator simulator(leaf, options);
    std::string said;
    calling.inside = [&] { said = message<Error>([&] { call(simulator, start); }); };
    simulator.initialize(start);
    CHECK(simulator.advance_to(1.0) == Status::reached_end);
    CHECK(contains(said, name + " was called by a callback of the run itself"));
    CHECK(same_bits(simulator.context(), plain.context));
    CHECK(column(simulator.results(), "x") == column(plain, "x"));
  }
}

TEST_CASE("6.6 a call from another thread is an error and changes nothing", "[semantics]") {
  for (const auto& [name, call] : calls) {
    INFO(name);
    Calling calling;
    const Leaf leaf = calling.leaf();
    const Context start = leaf.create_context();
    const Results plain = simulate(leaf, start, {0.0, 1.0});
    Simulator simulator(leaf);
    std::string said;
    // The run waits in its derivative until the other thread has called.
    calling.inside = [&] {
      std::jthread([&] { said = message<Error>([&] { call(simulator, start); }); }).join();
    };
    simulator.initialize(start);
    simulator.advance_to(1.0);
    CHECK(contains(said, name + " was called while another thread uses the simulator"));
    CHECK(same_bits(simulator.context(), plain.context));
  }
}

TEST_CASE("6.6 after a call that failed the simulator is free again", "[semantics]") {
  Calling calling;
  const Leaf leaf = calling.leaf();
  Simulator simulator(leaf);
  CHECK_THROWS_AS(simulator.advance_to(1.0), ModelError);  // not initialized
  simulator.initialize(leaf.create_context());
  CHECK_THROWS_AS(simulator.advance_to(-1.0), ModelError);
  CHECK(simulator.advance_to(1.0) == Status::reached_end);
}

TEST_CASE("6.6 a block in use declares nothing more", "[semantics]") {
  const std::vector<std::pair<std::string, std::function<void(Leaf&)>>> declarations{
      {"continuous state", [](Leaf& l) { l.declare_continuous_state({.initial = vec({1.0})}); }},
      {"discrete state", [](Leaf& l) { l.declare_discrete_state(vec({1.0})); }},
      {"mode", [](Leaf& l) { l.declare_default_mode(1); }},
      {"parameter", [](Leaf& l) { l.declare_dynamic_parameter("k", 1.0); }},
      {"input", [](Leaf& l) { l.declare_input_port(); }},
      {"output", [](Leaf& l) { l.declare_continuous_state_output("more"); }},
      {"crossing",
       [](Leaf& l) { l.declare_zero_crossing({.guard = [](const At&) { return 1.0; }}); }},
      {"relation", [](Leaf& l) { l.declare_relation({.guard = [](const At&) { return 1.0; }}); }},
      {"edge",
       [](Leaf& l) { l.declare_edge_reset({.input = 0, .reset_map = [](const At&, Next&) {}}); }},
      {"update", [](Leaf& l) { l.declare_periodic_update([](const At&, Next&) {}, 1.0); }},
      {"one shot", [](Leaf& l) { l.declare_one_shot(1.0); }},
      {"jacobian", [](Leaf& l) { l.declare_jacobian([](const At&, MatrixRef) {}); }},
      {"sparsity", [](Leaf& l) { l.declare_jacobian_sparsity({}); }}};
  for (const auto& [name, declare] : declarations) {
    INFO(name);
    Calling calling;
    Leaf leaf = calling.leaf();
    Context start = leaf.create_context();  // a context is no use of it
    const auto refused = [&] {
      return contains(message<ModelError>([&] { declare(leaf); }), "block 'leaf' is in use");
    };
    {
      Simulator simulator(leaf);
      CHECK(refused());
      calling.inside = [&] { CHECK(refused()); };
      simulator.initialize(start);
      CHECK(simulator.advance_to(1.0) == Status::reached_end);
      CHECK(calling.called);
    }
    {
      const auto plan = compile(leaf);
      CHECK(refused());
    }
    {
      DiagramBuilder builder;
      builder.add(std::shared_ptr<const System>(std::shared_ptr<void>(), &leaf));
      const Diagram diagram = builder.build();
      CHECK(refused());
    }
    if (name != "continuous state") CHECK_NOTHROW(declare(leaf));  // nobody uses it any more
  }
}
