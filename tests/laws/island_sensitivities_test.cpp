// Derivatives of a run by islands are those of each part alone, to the bit.
#include "support/islands.hpp"

using namespace saltus;
using namespace support;

namespace {

Results run(const std::set<int>& parts, std::vector<std::string> names) {
  const Diagram scene = scene_of(parts);
  SimulatorOptions options{.recorded_signals = outputs_of(scene), .islands = true};
  options.sensitivity = std::move(names);
  return simulate(scene, start_of(scene, parts), {0.0, 1.0}, options);
}

/// Column k of m columns.
std::vector<double> every(const std::vector<double>& values, std::size_t m, std::size_t k) {
  std::vector<double> some;
  for (std::size_t i = k; i < values.size(); i += m) some.push_back(values[i]);
  return some;
}

bool all_zero(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return value == 0.0; });
}

}  // namespace

TEST_CASE("an island has the derivatives of its part alone", "[islands][sensitivities]") {
  const Results both = run({0, 1}, {"second.g", "first.g"}), first = run({0}, {"first.g"}),
                second = run({1}, {"second.g"});
  REQUIRE(both.islands.size() == 2);
  const Sensitivities &all = both.sensitivities, &a = first.sensitivities,
                      &b = second.sensitivities;
  CHECK(every(all.signals[0], 2, 1) == a.signals[0]);
  CHECK(every(all.signals[1], 2, 0) == b.signals[0]);
  CHECK(all_zero(every(all.signals[0], 2, 0)));
  CHECK(all_zero(every(all.signals[1], 2, 1)));
  const std::vector<double> by_g = every(all.continuous_state, 2, 1);
  CHECK(std::vector(by_g.begin(), by_g.begin() + 2) == a.continuous_state);
  CHECK(all_zero({by_g.begin() + 2, by_g.end()}));
}
