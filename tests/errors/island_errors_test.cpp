// Islands: what is refused, with the option, the number of islands and the remedy.
#include <chrono>
#include <thread>

#include "saltus/simulation/ensemble.hpp"
#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

const std::set<int> parts{0, 1};

std::string refused(const SimulatorOptions& options) {
  const Diagram scene = scene_of(parts);
  return message<ModelError>([&] { Simulator(scene, options); });
}

Context ended(const Diagram& scene, bool islands) {
  return simulate(scene, start_of(scene, parts), {0.0, 1.0}, {.islands = islands}).context;
}

}  // namespace

TEST_CASE("a name of the option sensitivity that is unknown is refused", "[errors][islands]") {
  SimulatorOptions sensitive{.islands = true};
  sensitive.sensitivity = {"first.h"};
  CHECK(contains(refused(sensitive), "unknown parameter or state 'first.h'"));
}

TEST_CASE("a context fits the way of its run", "[errors][islands]") {
  const Diagram scene = scene_of(parts);
  for (const bool islands : {true, false}) {
    const Context end = ended(scene, islands);
    Simulator other(scene, {.islands = !islands});
    const std::string error = message<ModelError>([&] { other.initialize(end); });
    CHECK(contains(error, islands ? "whose islands stepped apart" : "one common step"));
    CHECK(contains(error, "set its time to the same value by with_time"));
    other.initialize(end.with_time(end.time()));  // the remedy
    CHECK(other.advance_to(2.0) == Status::reached_end);
  }
}

TEST_CASE("a time in the past, no values, and a second start are refused", "[errors][islands]") {
  const Diagram scene = scene_of(parts);
  Simulator simulator(scene, {.islands = true});
  CHECK(contains(message<ModelError>([&] { simulator.advance_to(1.0); }), "initialize(context)"));
  simulator.initialize(start_of(scene, parts));
  simulator.advance_to(1.0);
  CHECK(contains(message<ModelError>([&] { simulator.advance_to(0.5); }), "back to t = 0.5 s"));
}

TEST_CASE("an interrupted run ends at a time that all islands have reached", "[errors][islands]") {
  DiagramBuilder builder;
  for (const char* name : {"one", "two", "three"})
    builder.add(make_leaf(name, [](Leaf& l) {
      l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                    return -at.x[0];
                                  }});
    }));
  const Diagram scene = builder.build();
  int asked = 0;
  SimulatorOptions options{.islands = true, .throw_errors = false};
  options.interrupt = [&] { return ++asked == 2; };  // after at least two times 20 ms
  Simulator simulator(scene, options);
  simulator.initialize(scene.create_context());
  CHECK(simulator.advance_to(100.0) == Status::interrupted);
  const Results& results = simulator.results();
  CHECK(contains(results.message, "interrupted"));
  for (const IslandResults& island : results.islands)
    for (const double t : island.time) CHECK(t <= results.context.time());
  simulator.initialize(results.context);  // and it goes on
  CHECK(simulator.advance_to(results.context.time() + 0.1) == Status::reached_end);
}

TEST_CASE("an exception of the question between two islands ends the run", "[errors][islands]") {
  DiagramBuilder builder;
  for (const char* name : {"one", "two"})
    builder.add(make_leaf(name, [](Leaf& l) {
      l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At&) {
                                    std::this_thread::sleep_for(std::chrono::milliseconds(15));
                                    return 0.0;
                                  }});
    }));
  const Diagram scene = builder.build();
  SimulatorOptions options{.islands = true};
  options.interrupt = []() -> bool { throw std::runtime_error("no answer"); };
  Simulator simulator(scene, options);
  simulator.initialize(scene.create_context());
  CHECK(contains(message<std::exception>([&] { simulator.advance_to(1.0); }), "no answer"));
  CHECK(simulator.results().status == Status::failed);
}
