// IslandInterrupt: who asks the user whether a run by islands has to stop, and who knows the answer.
#include "saltus/simulation/detail/island_interrupt.hpp"

#include <stdexcept>
#include <thread>

#include "support/catch.hpp"

using saltus::IslandInterrupt;

namespace island_interrupt {

namespace {

/// A user who gives one answer, at a time when it may be asked.
struct User {
  bool answer = true;
  int asked = 0, noted = 0;
  IslandInterrupt interrupt{[this] { return ++asked, answer; }, [this] { ++noted; }};

  User() {
    interrupt.begin(), interrupt.begin_piece();
    std::this_thread::sleep_for(std::chrono::milliseconds(21));
  }
};

}  // namespace

TEST_CASE("an island asks, after the run has noted how far it is, and the others know the answer") {
  User user;
  CHECK_FALSE(user.interrupt.stops());
  CHECK(user.interrupt.asks());
  CHECK(user.asked == 1);
  CHECK(user.noted == 1);
  CHECK(user.interrupt.stops());
}

TEST_CASE("only the thread that called the run asks") {
  User user;
  bool stops = true, is_caller = true;
  std::jthread([&] {
    stops = user.interrupt.asks();
    is_caller = user.interrupt.is_on_caller();
  }).join();
  CHECK_FALSE(stops);
  CHECK_FALSE(is_caller);
  CHECK(user.asked == 0);
  user.interrupt.asks();
  std::jthread([&] { stops = user.interrupt.asks(); }).join();
  CHECK(stops);
  CHECK(user.asked == 1);
}

TEST_CASE("islands that run again are not interrupted") {
  User user;
  user.interrupt.run_again(true);
  CHECK_FALSE(user.interrupt.asks());
  CHECK(user.asked == 0);
  user.interrupt.run_again(false);
  CHECK(user.interrupt.asks());
}

TEST_CASE("the next piece of a run is not stopped yet") {
  User user;
  user.interrupt.asks();
  user.interrupt.begin_piece();
  CHECK_FALSE(user.interrupt.stops());
}

TEST_CASE("nobody is asked where the user gave no function") {
  IslandInterrupt interrupt({}, [] { FAIL("noted"); });
  interrupt.begin(), interrupt.begin_piece();
  std::this_thread::sleep_for(std::chrono::milliseconds(21));
  CHECK_FALSE(interrupt.asks());
}

TEST_CASE("an exception of the user passes through a run, and is kept between two") {
  IslandInterrupt interrupt([]() -> bool { throw std::runtime_error("no"); }, [] {});
  interrupt.begin(), interrupt.begin_piece();
  std::this_thread::sleep_for(std::chrono::milliseconds(21));
  CHECK_THROWS_AS(interrupt.asks(), std::runtime_error);
  CHECK(interrupt.stops());
  CHECK_FALSE(interrupt.raised());
  std::this_thread::sleep_for(std::chrono::milliseconds(21));
  CHECK(interrupt.asks_between());
  CHECK_THROWS_AS(std::rethrow_exception(interrupt.raised()), std::runtime_error);
  interrupt.begin();
  CHECK_FALSE(interrupt.raised());
}

}  // namespace island_interrupt
