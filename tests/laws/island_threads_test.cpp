// Islands on several threads: the bits, the end and the errors of a run do not depend on their number.
#include <chrono>
#include <thread>

#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Balls of different heights with drag-free flights, and rooms with different heaters.
Diagram many(int n) {
  DiagramBuilder builder;
  for (int i = 0; i < n; ++i) {
    builder.add(std::make_shared<Ball>(BallOptions{.e = 0.5 + 0.01 * i}, text("ball", i)));
    builder.add(room(text("room", i), 25.0 + i));
  }
  return builder.build();
}

Context start_of_many(const Diagram& scene) {
  Eigen::VectorXd x = scene.create_context().continuous_state();
  for (Index i = 0; i < x.size(); i += 3) x[i] = 1.0 + 0.1 * static_cast<double>(i);
  return scene.create_context().with_continuous_state(x);
}

/// x = height - t with a terminal guard at zero.
std::shared_ptr<Leaf> fuse(const std::string& name, double height) {
  return make_leaf(name, [height](Leaf& l) {
    l.declare_continuous_state({.initial = vec({height}), .ode = [](const At&) { return -1.0; }});
    l.declare_zero_crossing(
        {.name = "bang", .guard = [](const At& at) { return at.x[0]; }, .terminal = true});
  });
}

/// A leaf each of whose derivatives takes some milliseconds.
Diagram slow(int n) {
  DiagramBuilder builder;
  for (int i = 0; i < n; ++i)
    builder.add(make_leaf(text("slow", i), [](Leaf& l) {
      l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                    std::this_thread::sleep_for(std::chrono::milliseconds(2));
                                    return -at.x[0];
                                  }});
    }));
  return builder.build();
}

}  // namespace

TEST_CASE("islands have the same bits on any number of threads", "[laws][islands]") {
  const Diagram scene = many(12);
  const Context start = start_of_many(scene);
  const Results one = simulate(scene, start, {0.0, 4.0}, {.islands = true});
  REQUIRE(one.events.size() > 100);
  for (const int threads : {0, 2, 3, 100}) {
    const Results some =
        simulate(scene, start, {0.0, 4.0}, {.islands = true, .island_threads = threads});
    CHECK(same_bits(some.context, one.context));
    CHECK(same_bits(some.events, one.events));
    CHECK(some.statistics.steps == one.statistics.steps);
    bool same = true;
    for (std::size_t k = 0; k < one.islands.size(); ++k)
      same = same && some.islands[k].time == one.islands[k].time;
    CHECK(same);
  }
}

TEST_CASE("on threads too the earliest end is the end of all", "[laws][islands]") {
  for (int first = 0; first < 8; ++first) {
    DiagramBuilder builder;
    for (int i = 0; i < 8; ++i)
      builder.add(fuse(text("fuse", i), i == first ? 0.5 : 1.0 + 0.1 * i));
    const Diagram scene = builder.build();
    const Results one = simulate(scene, scene.create_context(), {0.0, 5.0}, {.islands = true});
    const Results two =
        simulate(scene, scene.create_context(), {0.0, 5.0}, {.islands = true, .island_threads = 2});
    CHECK(two.status == Status::terminal);
    CHECK(two.message == one.message);
    CHECK(same_bits(two.context, one.context));
    CHECK(count(two.events, EventKind::terminal) == 1);
  }
}

TEST_CASE("of two islands that end at one time the first is named", "[laws][islands]") {
  DiagramBuilder builder;
  for (const char* name : {"a", "b", "c"}) builder.add(fuse(name, 1.0));
  const Diagram scene = builder.build();
  const Results one = simulate(scene, scene.create_context(), {0.0, 5.0}, {.islands = true});
  for (int again = 0; again < 300; ++again) {
    const Results two =
        simulate(scene, scene.create_context(), {0.0, 5.0}, {.islands = true, .island_threads = 3});
    CHECK(two.message == one.message);
    // Which island is the first to end depends on the threads, and nothing else does.
    CHECK(same_bits(two.context, one.context));
    CHECK(same_bits(two.events, one.events));
    CHECK(two.statistics.right_hand_side_calls == one.statistics.right_hand_side_calls);
  }
}

TEST_CASE("an error on a thread keeps its cause, and the others their bits", "[laws][islands]") {
  DiagramBuilder builder;
  for (int i = 0; i < 6; ++i)
    builder.add(make_leaf(text("leaf", i), [i](Leaf& l) {
      l.declare_continuous_state({.initial = vec({0.0}), .ode = [i](const At& at) {
                                    if (i == 4 && at.time > 0.5)
                                      throw std::runtime_error("a fuse blew");
                                    return 1.0;
                                  }});
    }));
  const Diagram scene = builder.build();
  const SimulatorOptions options{.islands = true, .island_threads = 2, .throw_errors = false};
  const Results results = simulate(scene, scene.create_context(), {0.0, 5.0}, options);
  CHECK(results.status == Status::failed);
  CHECK(contains(results.message, "a fuse blew"));
  CHECK(results.context.time() <= 0.5);
  // Slope 1 from 0: the sum of a few steps.
  for (const double x : results.context.continuous_state())
    CHECK(std::abs(x - results.context.time()) <= 8.0 * eps);
}

// Only the calling thread asks; a thread that has no island left asks while it waits.
TEST_CASE("a run on threads is interrupted, and goes on", "[laws][islands]") {
  const Diagram scene = slow(4);
  const auto caller = std::this_thread::get_id();
  int asked = 0;
  bool elsewhere = false;
  SimulatorOptions options{.islands = true, .island_threads = 3, .throw_errors = false};
  options.interrupt = [&] {
    elsewhere = elsewhere || std::this_thread::get_id() != caller;
    return ++asked == 2;
  };
  Simulator simulator(scene, options);
  simulator.initialize(scene.create_context());
  CHECK(simulator.advance_to(1000.0) == Status::interrupted);
  CHECK_FALSE(elsewhere);
  const Results results = simulator.results();
  CHECK(contains(results.message, "interrupted"));
  for (const IslandResults& island : results.islands)
    for (const double t : island.time) CHECK(t <= results.context.time());
  simulator.initialize(results.context);
  CHECK(simulator.advance_to(results.context.time() + 0.01) == Status::reached_end);
}

TEST_CASE("what `interrupt` throws on threads is not lost", "[laws][islands]") {
  SimulatorOptions options{.islands = true, .island_threads = 2};
  options.interrupt = []() -> bool { throw std::runtime_error("no answer"); };
  const Diagram scene = slow(3);
  Simulator simulator(scene, options);
  simulator.initialize(scene.create_context());
  CHECK(contains(message<std::exception>([&] { simulator.advance_to(1000.0); }), "no answer"));
  CHECK(simulator.results().status == Status::failed);
}

TEST_CASE("threads without islands, and a negative number, are refused", "[laws][islands]") {
  const Diagram scene = slow(2);
  CHECK(contains(message<ModelError>([&] { Simulator(scene, {.island_threads = 2}); }),
                 "island_threads: expected 1, because islands is false"));
  CHECK(contains(
      message<ModelError>([&] { Simulator(scene, {.islands = true, .island_threads = -1}); }),
      "1 or more, or 0 for all cores"));
}
