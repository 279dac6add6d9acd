// Rates: what is constant, held, continuous.
#include "saltus/plan/rate.hpp"

#include "support/rates.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("the own rate of a value is that of the fastest thing it reads", "[rate]") {
  CHECK(own_rate(Reads::parameters, true, true, true) == Rate::constant);
  CHECK(own_rate(Reads::time, false, false, false) == Rate::continuous);
  CHECK(own_rate(Reads::continuous_state, true, false, false) == Rate::continuous);
  CHECK(own_rate(Reads::continuous_state, false, false, false) == Rate::constant);
  CHECK(own_rate(Reads::discrete_state, true, true, false) == Rate::held);
  CHECK(own_rate(Reads::discrete_state, true, false, false) == Rate::constant);
  CHECK(own_rate(Reads::mode, false, false, true) == Rate::held);
  CHECK(own_rate(Reads::schedule, false, false, false) == Rate::held);
  CHECK(own_rate(Reads::schedule | Reads::continuous_state, true, false, false) == Rate::held);
  CHECK(own_rate(Reads::outside, false, false, false) == Rate::held);
  CHECK(own_rate(Reads::outside | Reads::continuous_state, true, false, false) == Rate::continuous);
  CHECK(own_rate(Reads::schedule | Reads::time, false, false, false) == Rate::continuous);
  CHECK(own_rate(Reads::discrete_state | Reads::time, false, true, false) == Rate::continuous);
  CHECK(faster(Rate::held, Rate::constant) == Rate::held);
  CHECK(faster(Rate::held, Rate::continuous) == Rate::continuous);
}

TEST_CASE("the rate of an output is the fastest of its own and its inputs'", "[rate]") {
  const Rates rates;
  const auto plan = compile(*rates.diagram, {{"c", rates.constant->output()},
                                             {"h", rates.held->output()},
                                             {"x", rates.continuous->output()},
                                             {"s", rates.slow->output()},
                                             {"f", rates.fast->output()}});
  const Rate expected[] = {Rate::constant, Rate::held, Rate::continuous, Rate::held,
                           Rate::continuous};
  for (std::size_t i = 0; i < 5; ++i) CHECK(plan->node(plan->taps[i].node).rate == expected[i]);
}
