// Interrupt: when a run asks its user whether to stop.
#include "saltus/simulation/detail/interrupt.hpp"

#include "support/catch.hpp"

using namespace saltus;

namespace {

struct Asked {
  int questions = 0, counts = 0;
  SimulatorOptions options;
  explicit Asked(bool answer) {
    options.interrupt = [this, answer] { return ++questions, answer; };
  }
  /// Takes steps; the number of the step after which the run is to stop, 0: none.
  int steps(Interrupt& interrupt, int count) {
    for (int i = 1; i <= count; ++i)
      if (interrupt.after_step([&] { ++counts; })) return i;
    return 0;
  }
};

}  // namespace

TEST_CASE("the user is asked at every sixteenth step at most", "[interrupt]") {
  Asked asked(true);
  Interrupt interrupt(asked.options);
  interrupt.begin();  // the last question was long ago
  CHECK(asked.steps(interrupt, 100) == 16);
  CHECK(asked.questions == 1);
  CHECK(asked.counts == 1);  // the counts are up to date when the user is asked
}

TEST_CASE("the user is not asked again before the time between two questions", "[interrupt]") {
  Asked asked(true);
  Interrupt interrupt(asked.options);
  interrupt.begin();
  interrupt.go_on(Interrupt::Clock::now() + std::chrono::hours(1));
  CHECK(asked.steps(interrupt, 1000) == 0);
  CHECK(asked.questions == 0);
  CHECK(asked.counts == 0);
}

TEST_CASE("a run that nobody interrupts asks nothing", "[interrupt]") {
  const SimulatorOptions options;
  Interrupt interrupt(options);
  interrupt.begin();
  int counts = 0;
  for (int i = 0; i < 100; ++i) CHECK_FALSE(interrupt.after_step([&] { ++counts; }));
  CHECK(counts == 0);
}
