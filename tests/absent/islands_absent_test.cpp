// An event of one island asks nothing of another: the calls of a scene are the sum of the calls of
// its parts, between two events there are only calls of one island, and an island at rest costs as
// much as alone.
#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

/// n balls, a leaf each, which start at heights that differ: no two bounce at one time.
Diagram balls(int n) {
  DiagramBuilder builder;
  for (int i = 0; i < n; ++i)
    builder.add(std::make_shared<Ball>(BallOptions{.e = 0.9}, text("ball_", i)));
  return builder.build();
}

Statistics of(int n, bool islands) {
  const Diagram scene = balls(n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * n);
  for (int i = 0; i < n; ++i) x[2 * i] = 1.0 + 0.01 * i;
  const Context start = scene.create_context().with_continuous_state(x);
  return simulate(scene, start, {0.0, 3.0}, {.islands = islands}).statistics;
}

/// A call of a function of a leaf.
struct Call {
  char leaf, kind;  // kind: derivative, guard, reset map
  double time;
  bool operator==(const Call&) const = default;
};

/// y'' = -9.81 from rest at the height `h`; it bounces at y = 0. It logs all calls.
std::shared_ptr<Leaf> logged_ball(char name, double h, std::vector<Call>& calls) {
  return make_leaf(std::string(1, name), [name, h, &calls](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({h, 0.0}), .ode = [=, &calls](const At& at, VectorRef dx) {
           calls.push_back({name, 'd', at.time});
           dx[0] = at.x[1], dx[1] = -9.81;
         }});
    l.declare_zero_crossing({.name = "bounce",
                             .guard =
                                 [=, &calls](const At& at) {
                                   calls.push_back({name, 'g', at.time});
                                   return at.x[0];
                                 },
                             .reset_map =
                                 [=, &calls](const At& at, Next& next) {
                                   calls.push_back({name, 'r', at.time});
                                   next.set_continuous_state({0.0, -0.8 * at.x[1]});
                                 },
                             .direction = Direction::positive_then_non_positive});
  });
}

/// All calls of a run of some of three balls.
std::vector<Call> calls_of(const std::string& names, const SimulatorOptions& options) {
  std::vector<Call> calls;
  DiagramBuilder builder;
  for (const char name : names) builder.add(logged_ball(name, 1.0 + 0.3 * (name - 'a'), calls));
  const Diagram scene = builder.build();
  const Context start = scene.create_context();
  calls.clear();  // those with which a leaf checks its declarations
  simulate(scene, start, {0.0, 2.0}, options);
  return calls;
}

std::vector<Call> of_leaf(char name, std::vector<Call> calls) {
  std::erase_if(calls, [name](const Call& call) { return call.leaf != name; });
  return calls;
}

/// The number of calls of other leaves between the first and the last bounce of each leaf.
std::ptrdiff_t strangers(const std::string& names, const std::vector<Call>& calls) {
  std::ptrdiff_t n = 0;
  for (const char name : names) {
    const auto bounce = [name](const Call& c) { return c.leaf == name && c.kind == 'r'; };
    const auto first = std::ranges::find_if(calls, bounce);
    const auto last = std::find_if(calls.rbegin(), calls.rend(), bounce).base();
    REQUIRE(std::count_if(first, last, bounce) >= 2);
    n += std::count_if(first, last, [name](const Call& c) { return c.leaf != name; });
  }
  return n;
}

}  // namespace

TEST_CASE("between two events of an island no other island is called", "[absent][islands]") {
  SimulatorOptions options;
  options.ode_solver_method = GENERATE(Method::dopri5, Method::dop853, Method::radau, Method::bdf);
  INFO("method " << options.ode_solver_method);
  const std::string names = "abc";
  CHECK(strangers(names, calls_of(names, options)) > 100);  // one common step calls all of them
  options.islands = true;
  const std::vector<Call> apart = calls_of(names, options);
  CHECK(strangers(names, apart) == 0);
  // Each island has the calls of its leaf alone, at the same times and in the same order.
  for (const char name : names)
    CHECK(of_leaf(name, apart) == of_leaf(name, calls_of(std::string(1, name), options)));
}

TEST_CASE("an event of one island asks nothing of another", "[absent][islands]") {
  int calls = 0, guards = 0;
  const auto still = make_leaf("still", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [&](const At& at) {
                                  ++calls;
                                  return -at.x[0];
                                }});
    l.declare_zero_crossing({.name = "never", .guard = [&](const At& at) {
                               ++guards;
                               return at.x[0] + 1.0;
                             }});
  });
  DiagramBuilder builder;
  builder.add(still);
  const Diagram alone = builder.build();
  simulate(alone, alone.create_context(), {0.0, 3.0}, {});
  const int calls_alone = std::exchange(calls, 0), guards_alone = std::exchange(guards, 0);
  REQUIRE(calls_alone > 0);
  DiagramBuilder both;
  both.add(still);
  both.add(std::make_shared<Ball>(BallOptions{}, "ball"));
  const Diagram scene = both.build();
  const Context start = scene.create_context().with_continuous_state(vec({1.0, 1.0, 0.0}));
  const Results results = simulate(scene, start, {0.0, 3.0}, {.islands = true});
  REQUIRE(results.events.size() > 3);
  CHECK(calls == calls_alone);
  CHECK(guards == guards_alone);
}

TEST_CASE("n balls have n times the calls of one ball", "[absent][islands]") {
  const Statistics one = of(1, true), ten = of(10, true), hundred = of(100, true);
  // Higher balls fly longer and bounce less often, so the counts are not exactly n times those of
  // the lowest ball: no ball has more events, and each has some.
  CHECK(ten.right_hand_side_calls <= 10 * one.right_hand_side_calls + 10 * 8);
  CHECK(hundred.right_hand_side_calls <= 100 * one.right_hand_side_calls + 100 * 8);
  CHECK(hundred.steps <= 100 * one.steps + 100 * 2);
  // With a common step each event cuts the step of all: the calls of each leaf are those of all.
  CHECK(100 * of(100, false).right_hand_side_calls > 10 * hundred.right_hand_side_calls);
}
