// Semantics 5.7: n threads give the bits of one.
#include <thread>

#include "support/balls.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("5.7 eight threads over one system give the bits of one", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.6})) {
    INFO(scene.form << ", method " << method);
    const auto run = [&] {
      return simulate(*scene.system, scene.context(1.0, 0.3), {0.0, 3.0},
                      {.ode_solver_method = method});
    };
    const Results alone = run();
    std::vector<Results> together(8);
    std::vector<std::thread> threads;
    for (Results& results : together) threads.emplace_back([&] { results = run(); });
    for (std::thread& thread : threads) thread.join();
    for (const Results& results : together) {
      CHECK(same_bits(results.context, alone.context));
      CHECK(same_bits(results.events, alone.events));
    }
  }
}
