// CrowdLocator: monitors that are located together fire as they would alone.
#include "saltus/solver/detail/crowd_locator.hpp"

#include "support/bouncing.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

using Function = std::function<double(double)>;

/// x' = 1, x(0) = start: one vector of monitors g_i(x).
std::shared_ptr<Leaf> monitors(std::vector<Function> g, double start = 0.0,
                               Direction direction = Direction::crosses_zero) {
  return std::make_shared<Leaf>("leaf", [&](Leaf& l) {
    declare_ramp(l, 1.0, start);
    const auto n = static_cast<Index>(g.size());
    l.declare_zero_crossing({.name = "g",
                             .guard =
                                 [g = std::move(g)](const At& at, VectorRef out) {
                                   for (Index i = 0; i < out.size(); ++i)
                                     out[i] = g[static_cast<std::size_t>(i)](at.x[0]);
                                 },
                             .direction = direction,
                             .size = n});
  });
}

/// Levels that are no simple fractions of a step.
std::vector<double> levels(int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(0.01 + 0.98 * std::fmod(0.618033988749895 * i, 1.0));
  return all;
}

std::vector<Function> differences(const std::vector<double>& at, const Function& of) {
  std::vector<Function> all;
  for (const double level : at) all.push_back([=](double x) { return of(x) - of(level); });
  return all;
}

Results run(const System& leaf, Method method = Method::dopri5, double end = 1.0) {
  return simulate(leaf, leaf.create_context(), {0.0, end}, {.ode_solver_method = method});
}

}  // namespace

TEST_CASE("each monitor of a crowd fires once, at its time, in the order of time",
          "[crowd_locator]") {
  const auto method = GENERATE(from_range(methods));
  struct Guarded {
    const char* name;
    Function g;
  };
  const auto guarded = GENERATE(values<Guarded>({
      {"lines", [](double x) { return x; }},
      {"falling lines", [](double x) { return -x; }},
      {"tiny", [](double x) { return 1e-200 * x; }},
      {"parabolas", [](double x) { return x * x; }},
      {"fast", [](double x) { return std::exp(3.0 * x); }},
      {"wave", [](double x) { return x + std::sin(40.0 * x) / 50.0; }},
      {"kink", [](double x) { return x < 0.3 ? x : 2.0 * x - 0.3; }},
  }));
  INFO("method " << method << ", " << guarded.name);
  std::vector<double> expected = levels(300);
  const Results results = run(*monitors(differences(expected, guarded.g)), method);
  REQUIRE(results.events.size() == expected.size());
  double before = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Event event = results.events[i];
    const double level = expected[static_cast<std::size_t>(event.entry)];
    CHECK(event.time >= before);
    before = event.time;
    // A hundred roundings of the time and of the step, and those of a state that grew by 1.
    CHECK(std::abs(event.time - level) <= 400.0 * eps);
    CHECK(event.before[0] - level >= -4.0 * eps);  // on the firing side, but for the rounding of t
  }
}

TEST_CASE("a crowd is located as the same monitors are one by one", "[crowd_locator]") {
  const Function wave = [](double x) { return std::sin(7.0 * x); };
  const std::vector<double> at = levels(100);
  const Results together = run(*monitors(differences(at, wave)));
  std::vector<std::pair<double, int>> alone;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Results one = run(*monitors(differences({at[k]}, wave)));
    for (std::size_t i = 0; i < one.events.size(); ++i)
      alone.emplace_back(one.events[i].time, one.events[i].direction);
  }
  std::ranges::sort(alone);
  REQUIRE(together.events.size() == alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    // sin(7 x) is flat at its extrema, and the levels are known to a rounding: the time is known to
    // the square root of it at worst.
    CHECK_THAT(together.events[i].time, Catch::Matchers::WithinAbs(alone[i].first, 1e-8));
  }
}

TEST_CASE("a crowd that crosses twice in a piece fires twice", "[crowd_locator]") {
  std::vector<Function> valleys;
  for (const double level : levels(40))
    valleys.push_back([=](double x) { return (x - level) * (x - level) - 1e-3; });
  const Results results =
      run(*monitors(valleys, 0.0, Direction::crosses_zero), Method::dopri5, 1.2);
  // sqrt(1e-3) = 0.03 on either side of each level; those below 0.03 begin inside their valley.
  const auto begun_inside =
      std::ranges::count_if(levels(40), [](double l) { return l * l < 1e-3; });
  CHECK(static_cast<long>(results.events.size()) == 80 - begun_inside);
}

TEST_CASE("a direction is that of each monitor of a crowd", "[crowd_locator]") {
  const std::vector<Function> up = differences(levels(50), [](double x) { return x; });
  CHECK(run(*monitors(up, 0.0, Direction::negative_then_non_negative)).events.size() == 50);
  CHECK(run(*monitors(up, 0.0, Direction::positive_then_non_positive)).events.empty());
}

TEST_CASE("monitors that cross at one time fire at one time, in declaration order",
          "[crowd_locator]") {
  const Function line = [](double x) { return x - 0.4; },
                 jump = [](double x) { return x < 0.4 ? -1.0 : 1.0; };
  for (const Function& g : {line, jump}) {
    const Results results = run(*monitors(std::vector<Function>(30, g)));
    REQUIRE(results.events.size() == 30);
    for (std::size_t i = 0; i < 30; ++i) {
      CHECK(results.events[i].time == results.events[0].time);
      CHECK(results.events[i].entry == static_cast<int>(i));
    }
  }
}

TEST_CASE("guards within the rounding of their terms are located by looks", "[crowd_locator]") {
  // At 1e6 the guards are known to 1e-10 only.
  std::vector<Function> rough;
  for (const double level : levels(40))
    rough.push_back([=](double x) { return (1e6 + x) - (1e6 + level); });
  const Results results = run(*monitors(rough));
  REQUIRE(results.events.size() == 40);
  for (std::size_t i = 0; i < 40; ++i) {
    const double level = levels(40)[static_cast<std::size_t>(results.events[i].entry)];
    CHECK(std::abs(results.events[i].time - level) <= 2.0 * eps * 1e6);
  }
}

TEST_CASE("a crowd changes no bit of a trajectory with resets", "[crowd_locator]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto ball = [](bool watched) {
    return Leaf("ball", [watched](Leaf& l) {
      declare_bouncing(l, 1.0, 10.0);
      if (!watched) return;
      l.declare_zero_crossing({.name = "level",
                               .guard =
                                   [](const At& at, VectorRef out) {
                                     for (Index i = 0; i < out.size(); ++i)
                                       out[i] = at.x[0] - 0.01 * static_cast<double>(i + 1);
                                   },
                               .size = 80});
    });
  };
  const Leaf plain = ball(false), watched = ball(true);
  const Results expected = run(plain, method, 3.0), found = run(watched, method, 3.0);
  CHECK(found.context.continuous_state() == expected.context.continuous_state());
  CHECK(found.events.times("bounce") == expected.events.times("bounce"));
  // The ball falls through 80 levels; its flights rise to 0.8^2k m and pass the levels below twice.
  CHECK(found.events.times("level").size() >= 390);
}

namespace {

/// A crowd of equal monitors g(u), looked at from u = 0 to `to` in a step that begins at t = 1.
class Crowded : private CrowdLocator {
 public:
  struct Parts {
    explicit Parts(const Function& g) : leaf(monitors(std::vector<Function>(10, g))) {
      machine.load(leaf->create_context());
      guards.select(machine.seen_guards().groups(), machine.plan());
    }
    std::shared_ptr<Leaf> leaf;
    Machine machine{compile(*leaf)};
    GuardSet guards{machine.plan()};
  };

  explicit Crowded(Parts& parts)
      : CrowdLocator(parts.machine, parts.guards, parts.guards.active().monitors) {
    t0_ = 1.0;
  }
  bool is_located(double to) {
    const auto at = [](double u, double* x) { x[0] = u; };
    look(0.0, nullptr, at, guards_->g);
    for (std::size_t k = 0; k < guards_->all().size(); ++k) guards_->arm(k, sign_of(guards_->g[k]));
    look_up_guards();
    look(to, nullptr, at, high_);
    REQUIRE(note_crossed(high_));
    return locate_crowd(0.0, to, at) == Crowd::located;
  }
};

bool is_located(const Function& g, double to) {
  Crowded::Parts parts(g);
  return Crowded(parts).is_located(to);
}

}  // namespace

TEST_CASE("an interval of some roundings of the time has no room for a polynomial",
          "[crowd_locator]") {
  const auto located_in = [](double roundings) {
    const double to = roundings * eps;
    return is_located([=](double u) { return u - 0.37 * to; }, to);
  };
  CHECK_FALSE(located_in(100.0));
  CHECK(located_in(3e4));
}

TEST_CASE("a crowd is located together only where its times are as exact as one by one",
          "[crowd_locator]") {
  CHECK(is_located([](double u) { return u - 0.3; }, 1.0));
  // The formula rounds by 8 eps of the largest value, 38: 100 eps where the slope is 3.
  CHECK_FALSE(
      is_located([](double u) { return 3.0 * (u - 0.3) + 105.0 * std::pow(u - 0.3, 3.0); }, 1.0));
}

TEST_CASE("a monitor that has passed with a crowd is at zero until it is clearly off",
          "[crowd_locator]") {
  // The polynomial is known to 8 eps of 0.3.
  const auto is_at_zero = [](double roundings) {
    Crowded::Parts parts([](double u) { return u - 0.3; });
    REQUIRE(Crowded(parts).is_located(0.3 + roundings * eps));
    return parts.guards[0].at_zero();
  };
  CHECK(is_at_zero(2.0));
  CHECK_FALSE(is_at_zero(200.0));
}

TEST_CASE("many monitors cost as many looks as one, and few are located one by one",
          "[crowd_locator]") {
  const auto looks = [](int count) {
    const std::vector<Function> all = differences(levels(count), [](double x) { return x; });
    return simulate(*monitors(all), monitors(all)->create_context(), {0.0, 1.0},
                    {.ode_solver_method = Method::dopri5, .first_step = 1.0})
        .statistics.guard_calls;
  };
  CHECK(looks(1) < 18);     // a line is located by two looks; seven more begin a run
  CHECK(looks(400) < 100);  // eleven a piece
}
