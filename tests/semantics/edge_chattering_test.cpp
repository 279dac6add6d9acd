// Semantics 4.7: a guard of edge_detection whose value varies all the time fires without end.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace edge_chattering_test {

/// x' = rate from `start`; a guard of edge_detection on value(x, t), with an effect or as a monitor.
struct Scene {
  const char* what;
  double start = 0.0, rate = 1.0;
  std::function<double(const At&)> value = [](const At& at) { return at.x[0] - 0.7; };
  std::function<void(const At&, Next&)> reset = {};
  int count = 1;  // guards of that kind
};

Leaf leaf(const Scene& scene) {
  return Leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({scene.start}), .ode = [rate = scene.rate](const At&) { return rate; }});
    l.declare_discrete_state(vec({0.0}));
    for (int i = 0; i < scene.count; ++i) {
      ZeroCrossing edge{
          .name = text("edge_", i), .guard = scene.value, .direction = Direction::edge_detection};
      if (scene.reset) edge.reset_map = scene.reset;
      l.declare_zero_crossing(std::move(edge));
    }
  });
}

const auto write_state = [](const At& at, Next& next) { next.set_continuous_state({at.x[0]}); };
const auto count_one = [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); };
const auto fast = [](const At& at) { return std::sin(1e6 * at.time); };

const std::vector<Scene> endless = {
    {.what = "a monitor"},
    {.what = "a monitor that begins at its zero", .start = 0.7},
    {.what = "a monitor of a slow number", .start = 1.0, .rate = 1e-9},
    {.what = "a monitor of the time", .value = [](const At& at) { return at.time; }},
    {.what = "a fast monitor", .value = fast},
    {.what = "many monitors", .count = 20},
    {.what = "a reset map that writes the state", .reset = write_state},
    {.what = "a reset map that counts", .reset = count_one},
    {.what = "a reset map that counts a slow number",
     .start = 1.0,
     .rate = 1e-9,
     .reset = count_one},
    {.what = "a fast guard that counts", .value = fast, .reset = count_one}};

}  // namespace edge_chattering_test

TEST_CASE("4.7 edge_detection of a number that varies all the time chatters", "[semantics]") {
  using namespace edge_chattering_test;
  const auto method = GENERATE(from_range(methods));
  for (const Scene& scene : endless) {
    INFO(scene.what << ", method " << method);
    const Leaf system = leaf(scene);
    const auto results = simulate(system, system.create_context(), {0.0, 2.0},
                                  {.ode_solver_method = method, .throw_errors = false});
    INFO(results.message);
    CHECK(results.status == Status::chattering);
    CHECK(results.block == "leaf");
    CHECK(results.events.size() <= 20'000);
    CHECK(contains(results.message, "guard 'leaf.edge_0' fired"));
    CHECK(contains(results.message, "crosses_zero"));
    CHECK(results.context.time() < 2.0);
    CHECK(results.context.continuous_state().allFinite());
  }
}

TEST_CASE("4.7 edge_detection of a staircase or of a truth goes on, however often it jumps",
          "[semantics]") {
  using namespace edge_chattering_test;
  const auto method = GENERATE(from_range(methods));
  const auto reset = GENERATE(0, 1);
  // 3000 stairs, and twice as many jumps of a truth: x = 1000 t over 3 s.
  const Scene stairs{.what = "stairs",
                     .start = 0.5,
                     .rate = 1e3,
                     .value = [](const At& at) { return std::floor(at.x[0]); },
                     .reset = reset ? count_one : std::function<void(const At&, Next&)>()};
  const Leaf system = leaf(stairs);
  const auto results =
      simulate(system, system.create_context(), {0.0, 3.0},
               {.ode_solver_method = method, .max_minor_step_size = 0.4e-3, .throw_errors = false});
  INFO("method " << method << ": " << results.message);
  CHECK(results.status == Status::reached_end);
  CHECK(results.events.size() == 3000);
}
