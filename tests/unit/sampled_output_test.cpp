// A sampler behind an output: what reads or records the output reads the sampler.
#include "saltus/library/rate_transition.hpp"
#include "support/cases.hpp"
#include "support/catch.hpp"
#include "support/run.hpp"

namespace {

using namespace saltus;
using namespace support;

std::shared_ptr<Leaf> clock_with(std::shared_ptr<const LeafSystem> sampler) {
  return make_leaf("clock", [&](Leaf& leaf) {
    leaf.declare_output_port({.name = "t",
                              .calc = [](const At& at) { return at.time; },
                              .reads = Reads::time,
                              .sampler = std::move(sampler)});
  });
}

std::shared_ptr<const LeafSystem> every(double period, double offset) {
  return std::make_shared<RateTransition>("t", period, RateTransition::Options{-1.0, offset});
}

}  // namespace

TEST_CASE("a sampled output is held from tick to tick") {
  const auto clock = clock_with(every(0.5, 0.25));
  const auto results =
      simulate(*clock, clock->create_context(), {0.0, 1.5},
               {.recorded_signals = {{"t", clock->output()}}, .save_at = {0.125, 0.5, 1.0}});
  const std::vector<double> held = column(results, "t");
  for (const auto& [time, value] : {std::pair{0.125, -1.0}, {0.5, 0.25}, {1.0, 0.75}})
    CHECK(held[rows_at(results, time).front()] == value);
}

TEST_CASE("a block with a sampled output is alone in its contexts") {
  const auto clock = clock_with(every(0.5, 0.0));
  const Context context = clock->create_context();
  CHECK(context.layout().leaves.size() == 2);
  CHECK(context.layout().leaves.back().path == "clock.t");
  CHECK(context.with_mode(2).mode() == 2);
  CHECK(context[clock->system_id()].discrete_state().size() == 0);
}

TEST_CASE("a sampler has one input and one output") {
  const auto none = make_leaf("none", [](Leaf&) {});
  CHECK_THROWS_AS(clock_with(none), ModelError);
}
