// Results that were taken out of a simulator: the run goes on as if they had not been.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("results that were taken leave the simulator fit for another run", "[laws][taken]") {
  const BallScene scene = leaf({.e = 0.6});
  Simulator simulator(*scene.system, {.recorded_signals = {{"y", scene.height}}});
  simulator.initialize(scene.context(1.0, 0.3));
  simulator.advance_to(4.0);
  const Results first = simulator.take_results();
  simulator.initialize(scene.context(1.0, 0.3));
  simulator.advance_to(4.0);
  CHECK(same_bits(first.context, simulator.results().context));
  CHECK(same_bits(first.events, simulator.results().events));
}

TEST_CASE("results that were taken in the middle of a run leave the rest to be recorded",
          "[laws][taken]") {
  const BallScene scene = leaf({.e = 0.6});
  Simulator whole(*scene.system, {.recorded_signals = {{"y", scene.height}}});
  Simulator pieces(*scene.system, {.recorded_signals = {{"y", scene.height}}});
  for (Simulator* simulator : {&whole, &pieces}) {
    simulator->initialize(scene.context(1.0, 0.3));
    simulator->advance_to(0.2);
  }
  const Results first = pieces.take_results();
  for (Simulator* simulator : {&whole, &pieces}) simulator->advance_to(4.0);
  const Results& all = whole.results();
  const Results& rest = pieces.results();
  REQUIRE(!rest.time.empty());
  CHECK(rest.time.size() + first.time.size() <= all.time.size() + 1);  // 0.2 s may be in both
  CHECK(rest.output("y").rows() == static_cast<Index>(rest.time.size()));
  CHECK(rest.output("y").bottomRows(1) == all.output("y").bottomRows(1));
}
