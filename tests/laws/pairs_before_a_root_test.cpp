// Monitors that cross zero twice before another guard does, in one step of the solver.
#include <random>

#include "support/cases.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Where two parabolas and a line, all of them functions of x = t, are zero; in [0, 1].
struct Zeros {
  double first[2], second[2], line;

  explicit Zeros(std::mt19937& draw) {
    const auto pick = [&](double from, double to) {
      return std::uniform_real_distribution(from, to)(draw);
    };
    line = pick(0.3, 0.99);
    for (double* pair : {first, second}) {
      pair[1] = pick(0.1, line - 1e-3);
      pair[0] = pick(0.01, pair[1] - 0.02);
    }
  }
  std::vector<std::pair<double, std::string>> expected() const {
    std::vector<std::pair<double, std::string>> all = {{first[0], "first"},
                                                       {first[1], "first"},
                                                       {second[0], "second"},
                                                       {second[1], "second"},
                                                       {line, "line"}};
    std::ranges::sort(all);
    return all;
  }
};

/// x' = 1 with the two parabolas as monitors; the line is a monitor, or counts.
std::shared_ptr<Leaf> make(const Zeros& at, bool counts) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, 1.0, 0.0);
    l.declare_discrete_state(vec({0.0}));
    for (const bool second : {false, true}) {
      const double low = (second ? at.second : at.first)[0],
                   high = (second ? at.second : at.first)[1];
      l.declare_zero_crossing({.name = second ? "second" : "first", .guard = [=](const At& now) {
                                 return (now.x[0] - low) * (now.x[0] - high);
                               }});
    }
    l.declare_zero_crossing({.name = "line",
                             .guard = [=](const At& now) { return now.x[0] - at.line; },
                             .reset_map = counts ? ResetMap(count_up) : ResetMap()});
  });
}

}  // namespace

TEST_CASE("monitors cross twice before another guard does, each at its own time",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(false, true);
  std::mt19937 draw(11);
  for (int i = 0; i < 200; ++i) {
    const Zeros zeros(draw);
    const auto leaf = make(zeros, counts);
    const Results results = simulate(*leaf, leaf->create_context(), {0.0, 1.0},
                                     {.ode_solver_method = method, .first_step = 1.0});
    INFO("method " << method << ", scene " << i << (counts ? ", counts" : ""));
    const auto expected = zeros.expected();
    CHECK(results.events.size() == expected.size());
    if (results.events.size() != expected.size()) continue;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      CHECK(results.events[k].name == expected[k].second);
      // The state is known to some roundings of its size, 1, and so are the factors of a parabola; the
      // slope at its zeros is their distance, 0.02 at least.
      CHECK_THAT(results.events[k].time, Catch::Matchers::WithinAbs(expected[k].first, 1e-12));
    }
  }
}
