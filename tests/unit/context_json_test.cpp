// A context as JSON: the same bits come back, and what is no context of the system is refused.
#include "saltus/model/context_json.hpp"

#include "support/balls.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A context that is awkward to write: numbers without short decimal form, after bounces.
Context awkward(const BallScene& scene) {
  return simulate(*scene.system, scene.context(1.0 / 3.0, 1e-300), {0.1, 1.7},
                  {.rtol = 1e-9, .atol = 1e-11})
      .context;
}

}  // namespace

TEST_CASE("a context comes back from JSON to the last bit", "[context][json]") {
  for (const BallScene& scene : all_forms({.e = 0.6})) {
    INFO(scene.form);
    const Context context = awkward(scene);
    const Context back = context_from_json(*scene.system, to_json(context));
    CHECK(same_bits(back, context));
    CHECK(back.settled() == context.settled());
    REQUIRE(back.continuation() != nullptr);
    CHECK(*back.continuation() == *context.continuation());
  }
}

TEST_CASE("a run from a context read back is the run from the context, to the last bit",
          "[context][json]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.6})) {
    INFO(scene.form << ", method " << method);
    const Context context = awkward(scene);
    const Context back = context_from_json(*scene.system, to_json(context));
    const SimulatorOptions options{.ode_solver_method = method};
    const auto from_memory = simulate(*scene.system, context, {context.time(), 4.0}, options);
    const auto from_text = simulate(*scene.system, back, {back.time(), 4.0}, options);
    CHECK(same_bits(from_memory.events, from_text.events));
    CHECK(same_bits(from_memory.context, from_text.context));
  }
}

TEST_CASE("text that is no context of the system is refused", "[context][json][errors]") {
  const BallScene ball = leaf(), blocks_ball = blocks(support::Contact::comparator);
  const auto refused = [&](const std::string& text) {
    return message<ModelError>([&] { context_from_json(*ball.system, text); });
  };
  CHECK(contains(refused("{"), "a context in JSON"));
  CHECK(contains(refused("{}"), "format"));
  CHECK(contains(refused(to_json(blocks_ball.context(1.0, 0.0))), "blocks, found"));
  std::string other = to_json(ball.context(1.0, 0.0));
  other.replace(other.find("\"ball\""), 6, "\"bell\"");
  CHECK(contains(refused(other), "expected block 'ball', found 'bell'"));
}
