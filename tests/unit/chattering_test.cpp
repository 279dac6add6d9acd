// When a run of events is a chatter: counts and times only.
#include "saltus/simulation/detail/chattering.hpp"

#include <limits>

#include "support/catch.hpp"

using namespace saltus;

namespace {

const Eigen::VectorXd still = Eigen::VectorXd::Zero(1);

Chattering begun() {
  Chattering chattering({.rtol = 1e-6, .atol = 1e-8});
  chattering.begin(0.0, still);
  return chattering;
}

/// How many instants, one each `gap` seconds, until it says so; `most` + 1 if it does not.
int instants_until(Chattering& chattering, const Outcome& outcome, double gap, bool idle, int most,
                   double length_of_run = 1.0, bool executed = false) {
  for (int i = 1; i <= most; ++i) {
    const Chattering::Seen seen{1.0 + i * gap, !executed, length_of_run, executed};
    if (chattering.chatters(outcome, seen, idle, still)) return i;
  }
  return most + 1;
}

}  // namespace

TEST_CASE("A guard without a monitor that fires again and again chatters after a thousand times") {
  Chattering chattering = begun();
  CHECK(instants_until(chattering, {.stuck = true}, 1e-3, false, 2000) == 1000);
  CHECK(chattering.found().count == 1000);
}

TEST_CASE("A thousand firings with one instant without any among them do not chatter") {
  Chattering chattering = begun();
  CHECK(instants_until(chattering, {.stuck = true}, 1e-3, false, 999) == 1000);
  CHECK_FALSE(chattering.chatters({}, {3.0, true, 1.0}, false, still));
  CHECK(instants_until(chattering, {.stuck = true}, 1e-3, false, 999) == 1000);
}

TEST_CASE("A relation that flips back two hundred times in a row chatters") {
  Chattering chattering = begun();
  CHECK(instants_until(chattering, {.flutters = true}, 1e-3, false, 500) == 200);
}

TEST_CASE("An instant that does not end chatters at once, and says how many events it had") {
  Chattering chattering = begun();
  CHECK(chattering.chatters({.chatters = true, .events = 7}, {2.0, false, 1.0}, false, still));
  CHECK(chattering.found().count == 7);
  CHECK(chattering.found().since == 2.0);
}

TEST_CASE("Executions that set each other off count as roots do") {
  Chattering close = begun(), fast = begun();
  CHECK(instants_until(close, {}, 1e-14, false, 3000, 1.0, true) <= 2000);
  CHECK(instants_until(fast, {}, 1e-9, false, 3000, 1.0, true) == 3001);
}

TEST_CASE("Instants of time events alone do not chatter, however close they are") {
  Chattering chattering = begun();
  for (int i = 1; i <= 30'000; ++i)
    REQUIRE_FALSE(chattering.chatters({.stuck = true, .flutters = true},
                                      {1.0 + i * 1e-14, false, 1.0}, true, still));
}

TEST_CASE("Roots within the rounding of the time chatter; a fast rhythm does not") {
  Chattering close = begun(), fast = begun();
  CHECK(instants_until(close, {}, 1e-14, false, 3000) <= 2000);
  CHECK(instants_until(fast, {}, 1e-9, false, 3000) == 3001);
}

TEST_CASE(
    "Ten thousand roots in a ten-millionth of the run, between which nothing moves, chatter") {
  Chattering still_run = begun(), moving = begun(), longer = begun();
  // 1e4 roots each 1e-12 s take 1e-8 s: a 1e-7 part of a run of 0.1 s or more.
  CHECK(instants_until(still_run, {}, 1e-12, true, 30'000, 1.0) <= 20'000);
  CHECK(instants_until(moving, {}, 1e-12, false, 30'000, 1.0) == 30'001);
  CHECK(instants_until(longer, {}, 1e-12, true, 30'000, 1e-3) == 30'001);
  Chattering within = begun(), beyond = begun();  // the series takes 0.9e-7 or 1.1e-7 of the run
  CHECK(instants_until(within, {}, 0.9e-11, true, 30'000, 1.0) <= 20'000);
  CHECK(instants_until(beyond, {}, 1.1e-11, true, 30'000, 1.0) == 30'001);
}

namespace {

/// How many instants, one each `gap` seconds, until it says so, while a state flows at `rate`.
int executions_until(double gap, double rate, int most, double length_of_run) {
  Chattering chattering = begun();
  for (int i = 1; i <= most; ++i) {
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, i * gap * rate);
    const bool idle = chattering.idle(x);
    if (chattering.chatters({}, {1.0 + i * gap, false, length_of_run, true}, idle, x)) return i;
  }
  return most + 1;
}

}  // namespace

TEST_CASE("A million executions in a thousandth of the run, in which no state moves, chatter") {
  constexpr int most = 2'500'000;
  CHECK(executions_until(1e-9, 0.0, most, 10.0) <= 2'000'000);  // 1e-4 of the run
  CHECK(executions_until(0.9e-9, 0.0, most, 1.0) <= 2'000'000);
  CHECK(executions_until(1.1e-9, 0.0, most, 1.0) == most + 1);
  // The state flows by 1e-7 of its tolerance from event to event, which adds up to a tenth of it in a million.
  CHECK(executions_until(1e-9, 1e-6, most, 10.0) <= 2'000'000);
  CHECK(executions_until(1e-9, 1.0, most, 10.0) == most + 1);
}

TEST_CASE("A state that moved by its tolerance since the last root is not idle") {
  Chattering chattering = begun();
  CHECK(chattering.idle(still));
  CHECK(chattering.idle(Eigen::VectorXd::Constant(1, 0.9e-8)));
  CHECK_FALSE(chattering.idle(Eigen::VectorXd::Constant(1, 1.1e-8)));
  CHECK_FALSE(
      chattering.idle(Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN())));
}
