// Islands that step apart: each has the bits of its part run alone, and all end at one time.
#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

const std::set<int> all_parts{0, 1, 2, 3};

Results run(const Diagram& scene, const Context& context, double end, SimulatorOptions options) {
  options.recorded_signals = outputs_of(scene);
  options.throw_errors = false;
  return simulate(scene, context, {context.time(), end}, options);
}

Results run_of(const std::set<int>& parts, double end, SimulatorOptions options) {
  const Diagram scene = scene_of(parts);
  Results results = run(scene, start_of(scene, parts), end, std::move(options));
  results.context = {};  // its layout names the scene
  return results;
}

/// The events of the blocks that `part` has too are equal to the last bit, but for j, which counts
/// the jumps of all islands.
void same_events(const EventLog& whole, const EventLog& part) {
  std::set<std::string> blocks;
  for (std::size_t i = 0; i < part.size(); ++i) blocks.emplace(part[i].block);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Event a = whole[i];
    if (!blocks.contains(std::string(a.block))) continue;
    REQUIRE(seen < part.size());
    const Event b = part[seen++];
    CHECK(a.time == b.time);
    CHECK(a.kind == b.kind);
    CHECK(a.block == b.block);
    CHECK(a.name == b.name);
    CHECK(std::ranges::equal(a.before, b.before));
    CHECK(std::ranges::equal(a.after, b.after));
  }
  CHECK(seen == part.size());
}

void same_rows(const Results& whole, const Results& part) {
  for (const RecordedSignal& signal : part.signals) {
    CHECK(whole.output(signal.name) == part.output(signal.name));
    CHECK(whole.time_of(signal.name) == part.time_of(signal.name));
    CHECK(whole.jump_of(signal.name) == part.jump_of(signal.name));
  }
}

/// Time never decreases, and j increases by at most one from event to event.
void in_order(const EventLog& log) {
  for (std::size_t i = 1; i < log.size(); ++i) {
    CHECK(log[i - 1].time <= log[i].time);
    CHECK(log[i - 1].jump <= log[i].jump);
  }
}

}  // namespace

TEST_CASE("each island has the bits of its part run alone", "[laws][islands]") {
  const SimulatorOptions options{.ode_solver_method = GENERATE(from_range(methods)),
                                 .islands = true};
  INFO("method " << options.ode_solver_method);
  const Results whole = run_of(all_parts, 4.0, options);
  CHECK(whole.islands.size() == 4);
  in_order(whole.events);
  std::int64_t steps = 0, events = 0;
  for (int part = 0; part < number_of_parts; ++part) {
    INFO("part " << part);
    const Results alone = run_of({part}, 4.0, options);
    same_events(whole.events, alone.events);
    same_rows(whole, alone);
    const auto& island = whole.islands[static_cast<std::size_t>(part)];
    CHECK(island.statistics.steps == alone.statistics.steps);
    CHECK(island.statistics.events_by_name == alone.statistics.events_by_name);
    steps += alone.statistics.steps, events += alone.statistics.events;
  }
  CHECK(whole.statistics.steps == steps);
  CHECK(whole.statistics.events == events);
}

TEST_CASE("a scene of one island runs as without the option", "[laws][islands]") {
  const SimulatorOptions options{.ode_solver_method = GENERATE(from_range(methods))};
  const int part = GENERATE(0, 1, 2, 3);
  SimulatorOptions apart = options;
  apart.islands = true;
  const Diagram scene = scene_of({part});
  const Context start = start_of(scene, {part});
  const Results a = run(scene, start, 3.0, options), b = run(scene, start, 3.0, apart);
  CHECK(same_bits(a.events, b.events));
  CHECK(same_bits(a.context, b.context));
  CHECK(a.time == b.time);
  CHECK(b.islands.empty());
  CHECK(a.statistics.right_hand_side_calls == b.statistics.right_hand_side_calls);
}

TEST_CASE("a run in pieces has the events of the whole run", "[laws][islands]") {
  const Diagram scene = scene_of(all_parts);
  const Context start = start_of(scene, all_parts);
  SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .islands = true};
  options.recorded_signals = outputs_of(scene);
  Simulator whole(scene, options), pieces(scene, options);
  whole.initialize(start), pieces.initialize(start);
  whole.advance_to(3.0);
  for (const double t : {0.0, 0.5, 0.5, 1.25, 3.0}) pieces.advance_to(t);
  CHECK(events(whole.results().events) == events(pieces.results().events));
  in_order(pieces.results().events);
  // A piece ends a step: the states differ by the error of a step, some ten in each flight.
  const Eigen::VectorXd difference =
      whole.context().continuous_state() - pieces.context().continuous_state();
  CHECK(difference.cwiseAbs().maxCoeff() < 100.0 * 1e-9 * 10.0);
}

TEST_CASE("rows that were taken are not there again", "[laws][islands]") {
  const Diagram scene = scene_of(all_parts);
  SimulatorOptions options{.islands = true};
  options.recorded_signals = outputs_of(scene);
  Simulator whole(scene, options), taken(scene, options);
  whole.initialize(start_of(scene, all_parts)), taken.initialize(start_of(scene, all_parts));
  whole.advance_to(1.0), taken.advance_to(1.0);
  const Results first = taken.take_results();
  whole.advance_to(2.0), taken.advance_to(2.0);
  const Results second = taken.take_results();
  const Results& both = whole.results();
  CHECK(first.events.size() + second.events.size() == both.events.size());
  for (std::size_t k = 0; k < both.islands.size(); ++k) {
    std::vector<double> time = first.islands[k].time;
    time.insert(time.end(), second.islands[k].time.begin(), second.islands[k].time.end());
    CHECK(time == both.islands[k].time);
  }
}

TEST_CASE("a run resumes from its final context", "[laws][islands]") {
  const SimulatorOptions options{.ode_solver_method = GENERATE(from_range(methods)),
                                 .islands = true};
  const Diagram scene = scene_of(all_parts);
  const Results first = run(scene, start_of(scene, all_parts), 1.3, options);
  const Results second = run(scene, first.context, 4.0, options);
  CHECK(second.status == Status::reached_end);
  int jump = 0;
  for (std::size_t k = 0; k < 4; ++k) jump += first.islands[k].jump.back();
  if (!second.events.empty()) CHECK(second.events[0].jump == jump + 1);
  for (int part = 0; part < number_of_parts; ++part) {
    INFO("part " << part << ", method " << options.ode_solver_method);
    const Diagram own = scene_of({part});
    const Results begin = run(own, start_of(own, {part}), 1.3, options);
    const Results alone = run(own, begin.context, 4.0, options);
    same_events(second.events, alone.events);
    same_rows(second, alone);
  }
}

TEST_CASE("simultaneous events of two islands are in the order of declaration", "[laws][islands]") {
  DiagramBuilder builder;
  for (const char* name : {"one", "two", "three"})
    builder.add(std::make_shared<Ball>(BallOptions{}, name));
  const Diagram scene = builder.build();
  Eigen::VectorXd x(6);
  x << 1.0, 0.0, 1.0, 0.0, 1.0, 0.0;
  const Context start = scene.create_context().with_continuous_state(x);
  const Results results = simulate(scene, start, {0.0, 1.5}, {.islands = true});
  REQUIRE(results.events.size() == 6);  // two bounces of each: 0.45 s and 1.26 s
  const std::vector<std::string> order{"one", "two", "three", "one", "two", "three"};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(results.events[i].block == order[i]);
    CHECK(results.events[i].jump == static_cast<int>(i) + 1);
    CHECK(results.events[i].time == results.events[3 * (i / 3)].time);
  }
}

namespace {

/// A countdown that ends the run at `end` s.
std::shared_ptr<Leaf> bomb(const std::string& name, double end) {
  return make_leaf(name, [end](Leaf& l) {
    l.declare_continuous_state({.initial = vec({end}), .ode = [](const At&) { return -1.0; }});
    l.declare_zero_crossing(
        {.name = "bang", .guard = [](const At& at) { return at.x[0]; }, .terminal = true});
  });
}

}  // namespace

TEST_CASE("the run ends at the earliest terminal event, and every island ends there",
          "[laws][islands]") {
  const bool first = GENERATE(true, false);
  DiagramBuilder builder;
  if (first) builder.add(bomb("early", 0.75)), builder.add(bomb("late", 2.0));
  builder.add(std::make_shared<Ball>(BallOptions{}, "ball"));
  if (!first) builder.add(bomb("late", 2.0)), builder.add(bomb("early", 0.75));
  const Diagram scene = builder.build();
  Context start = scene.create_context();
  Eigen::VectorXd x = start.continuous_state();
  x[first ? 2 : 0] = 1.0;
  start = start.with_continuous_state(x);
  const Results results = simulate(scene, start, {0.0, 5.0}, {.islands = true});
  CHECK(results.status == Status::terminal);
  // x = 0.75 - t is exact in every step but for rounding.
  CHECK(std::abs(results.context.time() - 0.75) <= 8.0 * eps);
  CHECK(count(results.events, EventKind::terminal) == 1);
  CHECK(count(results.events, EventKind::zero_crossing, "bounce") == 1);  // at 0.45 s
  const Ball alone{BallOptions{}, "ball"};
  const Results ball =
      simulate(alone, alone.create_context().with_continuous_state(vec({1.0, 0.0})),
               {0.0, results.context.time()}, {});
  CHECK(results.context.continuous_state().segment(first ? 2 : 0, 2) ==
        ball.context.continuous_state());
}

TEST_CASE("a failure in one island ends all at its last accepted time", "[laws][islands]") {
  DiagramBuilder builder;
  builder.add(std::make_shared<Ball>(BallOptions{}, "ball"));
  builder.add(make_leaf("breaks", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At& at) {
                                  if (at.time > 0.5) throw std::runtime_error("a fuse blew");
                                  return 1.0;
                                }});
  }));
  const Diagram scene = builder.build();
  const Context start = scene.create_context().with_continuous_state(vec({1.0, 0.0, 0.0}));
  const Results results =
      simulate(scene, start, {0.0, 5.0}, {.islands = true, .throw_errors = false});
  CHECK(results.status == Status::failed);
  CHECK(contains(results.message, "a fuse blew"));
  const double t = results.context.time();
  CHECK(t <= 0.5);
  // Slope 1 from 0: the sum of a few steps.
  CHECK(std::abs(results.context.continuous_state()[2] - t) <= 8.0 * eps);
  const Ball alone{BallOptions{}, "ball"};
  const Results ball =
      simulate(alone, alone.create_context().with_continuous_state(vec({1.0, 0.0})), {0.0, t}, {});
  CHECK(results.context.continuous_state().head(2) == ball.context.continuous_state());
  CHECK(contains(
      message<std::exception>([&] { simulate(scene, start, {0.0, 5.0}, {.islands = true}); }),
      "a fuse blew"));
}

TEST_CASE("max_major_steps counts in each island", "[laws][islands]") {
  const Diagram scene = scene_of({0, 1});
  const Results results =
      run(scene, start_of(scene, {0, 1}), 5.0, {.max_major_steps = 3, .islands = true});
  CHECK(results.status == Status::step_limit);
  CHECK(contains(results.message, "max_major_steps"));
  for (const IslandResults& island : results.islands) CHECK(island.statistics.instants <= 3);
  CHECK(results.islands[0].time.back() == results.islands[1].time.back());
}

TEST_CASE("with save_at all signals have one table", "[laws][islands]") {
  const std::vector<double> times{0.0, 0.1, 0.45, 2.0, 3.0};
  const SimulatorOptions table{.save_at = times, .event_rows = false, .islands = true};
  const Results whole = run_of(all_parts, 3.0, table);
  CHECK(whole.time == times);
  for (int part = 0; part < number_of_parts; ++part) {
    const Results alone = run_of({part}, 3.0, table);
    for (const RecordedSignal& signal : alone.signals)
      CHECK(whole.output(signal.name) == alone.output(signal.name));
  }
}

TEST_CASE("tolerances by state go to the states of each island", "[laws][islands]") {
  SimulatorOptions by_state{.islands = true}, first, second;
  by_state.rtol = std::vector<double>{1e-4, 1e-4, 1e-9, 1e-9};
  first.rtol = 1e-4, second.rtol = 1e-9;
  const Results whole = run_of({0, 1}, 3.0, by_state);
  same_events(whole.events, run_of({0}, 3.0, first).events);
  same_events(whole.events, run_of({1}, 3.0, second).events);
}

namespace {

/// x' = 1 from 0; a queued zero crossing triggers at x = 1, and sets x to 0 after 0.5 s.
std::shared_ptr<Leaf> late(const std::string& name) {
  return make_leaf(name, [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.0; }});
    l.declare_zero_crossing(
        {.name = "late",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::negative_then_non_negative,
         .delay = 0.5});
  });
}

}  // namespace

TEST_CASE("blocks with queued zero crossings are one island, whose executions wait in the context",
          "[laws][islands]") {
  DiagramBuilder builder, queue;
  builder.add(late("one"));
  builder.add(std::make_shared<Ball>(BallOptions{}, "ball"));
  builder.add(late("two"));
  queue.add(late("one")), queue.add(late("two"));
  const Diagram scene = builder.build(), alone = queue.build();
  const Context start = scene.create_context().with_continuous_state(vec({0.0, 1.0, 0.0, 0.0}));
  const SimulatorOptions options{.islands = true};
  const Results first = simulate(scene, start, {0.0, 1.25}, options);
  REQUIRE(first.islands.size() == 2);
  REQUIRE(first.context.pending() != nullptr);
  CHECK(first.context.pending()->all.size() == 2);
  CHECK(first.context.pending()->all[0].leaf == 0);
  CHECK(first.context.pending()->all[1].leaf == 2);
  const Results second = simulate(scene, first.context, {1.25, 2.25}, options);
  const Results begin = simulate(alone, alone.create_context(), {0.0, 1.25}, {});
  const Results rest = simulate(alone, begin.context, {1.25, 2.25}, {});
  CHECK(count(second.events, EventKind::executed) == 2);
  same_events(first.events, begin.events);
  same_events(second.events, rest.events);
}
