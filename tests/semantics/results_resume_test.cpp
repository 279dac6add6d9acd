// Semantics 5.6: a run resumed from results.context is the unbroken run.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// Runs in pieces, each from the context of the one before.
struct Pieces {
  std::vector<std::string> kinds;
  Context context;
};
Pieces in_pieces(const System& system, Context context, const std::vector<double>& stops,
                 const SimulatorOptions& options) {
  Pieces all{{}, context};
  for (const double stop : stops) {
    const auto results = simulate(system, all.context, {all.context.time(), stop}, options);
    const auto kinds = events(results.events);
    all.kinds.insert(all.kinds.end(), kinds.begin(), kinds.end());
    all.context = results.context;
  }
  return all;
}

}  // namespace

TEST_CASE("5.6 a relation at exactly zero keeps its side across a split", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool rises = GENERATE(true, false);
  INFO("method " << method << ", rises " << rises);
  // A still state that a tick puts at exactly zero, from above or from below; split behind that.
  const Leaf leaf("leaf", [=](Leaf& l) {
    const auto relation = l.declare_relation(
        {.name = "side", .guard = [](const At& at) { return at.x[1]; }, .true_at_zero = !rises});
    l.declare_continuous_state(
        {.initial = vec({0.0, rises ? 1.0 : -1.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << (at.relation(relation) ? 1.0 : -1.0), 0.0;
         }});
    l.declare_one_shot(0.25,
                       [](const At& at, Next& next) { next.set_continuous_state({at.x[0], 0.0}); });
  });
  const SimulatorOptions options{.ode_solver_method = method};
  const auto whole = in_pieces(leaf, leaf.create_context(), {1.0}, options);
  const auto split = in_pieces(leaf, leaf.create_context(), {0.5, 0.75, 1.0}, options);
  CHECK_THAT(whole.context.continuous_state()[0], WithinAbs(rises ? 1.0 : -1.0, 1e-9));
  CHECK_THAT(split.context.continuous_state()[0], WithinAbs(rises ? 1.0 : -1.0, 1e-9));
}

TEST_CASE("5.6 a hold is known after a split, not found again", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.5})) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.ode_solver_method = method};
    const auto whole = in_pieces(*scene.system, scene.context(1.0, 0.0), {5.0}, options);
    const auto split = in_pieces(*scene.system, scene.context(1.0, 0.0), {2.0, 3.0, 5.0}, options);
    CHECK(split.kinds == whole.kinds);
    // Each piece accumulates anew from states that differ in their last digits.
    CHECK((split.context.continuous_state() - whole.context.continuous_state()).norm() < 1e-9);
  }
}

TEST_CASE("5.6 a hold that was split is released by the floor that would have released it",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto drop = [] {
    return std::make_shared<Step>("floor", Step::Options{.end_value = -2.0, .step_time = 3.0});
  };
  for (const BallScene& scene : all_forms_over({.e = 0.5}, drop)) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method};
    const auto whole = in_pieces(*scene.system, scene.context(1.0, 0.0), {3.5}, options);
    const auto split = in_pieces(*scene.system, scene.context(1.0, 0.0), {2.0, 3.0, 3.5}, options);
    CHECK(split.kinds == whole.kinds);
    CHECK_THAT(split.context.continuous_state()[0],
               WithinAbs(whole.context.continuous_state()[0], 1e-6));
  }
}

TEST_CASE("5.6 gaps are remembered across a split: the hold begins at the same bounce",
          "[semantics]") {
  const double before_rest = GENERATE(1e-3, 1e-5, 3e-6, 1.5e-6);  // [s]
  for (const BallScene& scene : all_forms({.g = 10.0, .e = 0.5})) {
    INFO(scene.form << ", split " << before_rest << " s before rest");
    const SimulatorOptions options{
        .rtol = 1e-10, .atol = 1e-14, .ode_solver_method = Method::dopri5};
    const double rest = BallExact{10.0, 0.5, 0.2}.rest();
    const auto whole = in_pieces(*scene.system, scene.context(0.2, 0.0), {1.0}, options);
    const auto split =
        in_pieces(*scene.system, scene.context(0.2, 0.0), {rest - before_rest, 1.0}, options);
    CHECK(split.kinds == whole.kinds);
  }
}

TEST_CASE("5.6 an event exactly at the split happens once", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.8})) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method};
    const auto whole = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 1.5}, options);
    const double bounce = whole.events[0].time;
    const auto split =
        in_pieces(*scene.system, scene.context(1.0, 0.0), {bounce, bounce, 1.5}, options);
    CHECK(split.kinds == events(whole.events));
    CHECK_THAT(split.context.continuous_state()[0],
               WithinAbs(whole.context.continuous_state()[0], 1e-6));
  }
}

TEST_CASE("5.6 a run split anywhere has the events of the unbroken run", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.7})) {
    const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method};
    const auto whole = in_pieces(*scene.system, scene.context(1.0, 0.0), {2.4}, options);
    for (int i = 1; i < 10; ++i) {
      const double split = 2.4 * std::fmod(0.6180339887498949 * i, 1.0);
      INFO(scene.form << ", method " << method << ", split at " << split);
      const auto pieces = in_pieces(*scene.system, scene.context(1.0, 0.0), {split, 2.4}, options);
      CHECK(pieces.kinds == whole.kinds);
      // Errors of 1e-9 a flight, multiplied by 1 + 1/e at each of ten bounces.
      CHECK_THAT(pieces.context.continuous_state()[0],
                 WithinAbs(whole.context.continuous_state()[0], 1e-5));
    }
  }
}

TEST_CASE("5.6 a context that was copied continues like the one it was copied from",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.8})) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.ode_solver_method = method};
    const auto first = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 1.0}, options);
    const Context saved = first.context;
    const auto a = simulate(*scene.system, first.context, {1.0, 2.0}, options);
    const auto b = simulate(*scene.system, saved, {1.0, 2.0}, options);
    CHECK(same_bits(a.context, b.context));
    CHECK(same_bits(a.events, b.events));
  }
}
