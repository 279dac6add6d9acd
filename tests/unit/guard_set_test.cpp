// Guard records: what each phase fires at, and who may change it.
#include "saltus/solver/detail/guard_set.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace saltus;

namespace {

constexpr auto falls = Direction::positive_then_non_positive;
constexpr auto rises = Direction::negative_then_non_negative;

GuardSet one(Direction direction) { return {{.direction = direction}}; }

}  // namespace

TEST_CASE("An unseen guard takes the first sign it has for its side, and does not fire") {
  GuardSet guards = one(falls);
  CHECK_FALSE(guards[0].crossed(-1.0));
  guards.see(0, 0.0);
  CHECK(guards[0].phase == Phase::unseen);
  guards.see(0, 2.0);
  CHECK(guards[0].phase == Phase::armed);
  CHECK(guards[0].side == 1);
}

TEST_CASE("An armed guard fires at zero and beyond, in its direction only") {
  GuardSet guards = one(falls);
  guards.arm(0, 1);
  CHECK(guards[0].crossed(0.0));
  CHECK(guards[0].crossed(-1e-300));
  CHECK_FALSE(guards[0].crossed(1e-300));
  guards.arm(0, -1);
  CHECK_FALSE(guards[0].crossed(1.0));
}

TEST_CASE("A waiting guard fires beyond its error only, and not before it was clearly off zero") {
  GuardSet guards = one(falls);
  guards.wait(0, 1, 1e-12);
  CHECK_FALSE(guards[0].crossed(0.0));
  CHECK_FALSE(guards[0].crossed(-1e-12));
  CHECK(guards[0].crossed(-2e-12));
  guards.follow(0, 5e-13);
  CHECK(guards[0].phase == Phase::waiting);
  guards.follow(0, 2e-12);
  CHECK(guards[0].phase == Phase::armed);
  CHECK(guards[0].error == 0.0);
  CHECK(guards[0].crossed(0.0));
}

TEST_CASE("A resting guard fires on leaving its error to either side, and no look arms it") {
  GuardSet guards = one(falls);
  guards.rest(0, -1, 1e-9);
  CHECK_FALSE(guards[0].crossed(1e-9));
  CHECK(guards[0].crossed(2e-9));
  CHECK(guards[0].crossed(-2e-9));
  guards.follow(0, 1e-10);
  CHECK(guards[0].phase == Phase::resting);
  guards.leave_rest(0);
  CHECK(guards[0].phase == Phase::waiting);
  CHECK(guards[0].error == 1e-9);
}

TEST_CASE("A carried guard fires where its lift rises to zero, whatever its own direction") {
  GuardSet guards = one(falls);
  guards.carry(0);
  CHECK(guards[0].watched_direction() == rises);
  CHECK(guards[0].direction == falls);
  CHECK_FALSE(guards[0].crossed(-1e-300));
  CHECK(guards[0].crossed(0.0));
  guards.leave_rest(0);
  CHECK(guards[0].watched_direction() == falls);
}

TEST_CASE("A guard whose mode is entered has no side; others keep theirs") {
  Plan plan;
  plan.guards = {{.slot = 0, .size = 1}, {.slot = 1, .size = 1}};
  GuardSet guards(plan);
  guards.select({0}, plan);
  guards.arm(0, 1);
  guards.arm(1, 1);
  guards.select({0, 1}, plan);
  CHECK(guards[0].side == 1);
  CHECK(guards[0].was_active);
  CHECK(guards[1].side == 0);
  CHECK(guards[1].phase == Phase::unseen);
  CHECK_FALSE(guards[1].was_active);
  CHECK(guards.active().all == std::vector<std::size_t>{0, 1});
}

TEST_CASE("What the engine writes counts the version up; what a locator sees does not") {
  GuardSet guards = one(falls);
  auto version = guards.version();
  const auto counted = [&] { return guards.version() != std::exchange(version, guards.version()); };
  guards.arm(0, 1);
  CHECK(counted());
  guards.follow(0, 1.0);
  guards.leave_zero(0);
  guards.leave_to(0, 1);
  guards.pass(0, -1, 0.0);
  CHECK_FALSE(counted());
  const std::vector<void (*)(GuardSet&)> written = {
      [](GuardSet& g) { g.wait(0, 1, 0.1); },
      [](GuardSet& g) { g.turn(0, -1); },
      [](GuardSet& g) { g.rest(0, 1, 0.1); },
      [](GuardSet& g) { g.leave_rest(0); },
      [](GuardSet& g) { g.carry(0); },
      [](GuardSet& g) { g.set_error(0, 0.1); },
      [](GuardSet& g) { g.set_base(0, 1.0); },
      [](GuardSet& g) { g.clear(); },
      [](GuardSet& g) { load_records(g, records_of(g)); }};
  for (const auto write : written) {
    write(guards);
    CHECK(counted());
  }
  guards.see(0, 1.0);
  CHECK(counted());
}

TEST_CASE("The limits of a guard are the first values at which it fires") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<double> values = {0.0, 0.1, 0.5};
  for (const double edge : {std::numeric_limits<double>::denorm_min(), std::nextafter(0.1, inf),
                            std::nextafter(0.5, inf), std::nextafter(0.5, 0.0)})
    values.push_back(edge);
  for (const Direction direction :
       {falls, rises, Direction::crosses_zero, Direction::edge_detection}) {
    for (const auto& arm : std::vector<void (*)(GuardSet&)>{
             [](GuardSet& g) { g.arm(0, 1); }, [](GuardSet& g) { g.arm(0, -1); },
             [](GuardSet& g) { g.wait(0, 1, 0.0); }, [](GuardSet& g) { g.wait(0, -1, 0.1); },
             [](GuardSet& g) { g.rest(0, 1, 0.1); }, [](GuardSet& g) { g.carry(0); },
             [](GuardSet& g) { g.arm(0, 1), g.set_error(0, 0.1); }, [](GuardSet&) {}}) {
      GuardSet guards = one(direction);
      guards.set_base(0, 0.5);
      arm(guards);
      const auto [first, second] = guards[0].limits();
      for (const double size : values) {
        for (const double value : {size, -size}) {
          INFO(to_string(direction)
               << " phase " << static_cast<int>(guards[0].phase) << " " << value);
          CHECK(guards[0].crossed(value) == (value <= first || value >= second));
        }
      }
    }
  }
}

TEST_CASE("A guard that stays does not fire, and a look changes no more than its last value") {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  int stay = 0;
  for (const Direction direction :
       {falls, rises, Direction::crosses_zero, Direction::edge_detection}) {
    for (const auto& arm : std::vector<void (*)(GuardSet&)>{
             [](GuardSet& g) { g.arm(0, 1); }, [](GuardSet& g) { g.arm(0, -1); },
             [](GuardSet& g) { g.arm(0, 1), g.set_error(0, 0.1); },
             [](GuardSet& g) { g.wait(0, 1, 0.0); }, [](GuardSet& g) { g.rest(0, 1, 0.0); },
             [](GuardSet& g) { g.carry(0); }, [](GuardSet&) {}}) {
      for (const double value : {0.0, least, -least, 0.5, -0.5}) {
        GuardSet guards = one(direction);
        arm(guards);
        if (!guards[0].stays(value)) continue;
        ++stay;
        CHECK_FALSE(guards[0].crossed(value));
        const Guard before = guards[0];
        guards.see(0, value);
        CHECK(guards[0].phase == before.phase);
        CHECK(guards[0].side == before.side);
        CHECK(guards[0].error == before.error);
      }
    }
  }
  CHECK(stay == 3 * 2 * 2);  // three directions, armed on two sides, at two values off zero each
}

TEST_CASE("A run that goes on knows what the records knew, in every phase but the contacts'") {
  for (const auto& arm : std::vector<void (*)(GuardSet&)>{
           [](GuardSet& g) { g.wait(0, 1, 0.25); }, [](GuardSet& g) { g.arm(0, -1); },
           [](GuardSet& g) { g.wait(0, 0, 0.5); }, [](GuardSet&) {}}) {
    GuardSet guards = one(falls);
    arm(guards);
    guards.fired(0, 1);
    guards.keep_truth(0, true);
    guards.set_base(0, 3.0);
    const Continuation saved{.guards = records_of(guards)};
    GuardSet later = one(falls);
    load_records(later, saved.guards);
    CHECK(records_of(later) == saved.guards);
    CHECK(later[0].phase == guards[0].phase);
  }
}
