// LineStates: which states move on a line, and which guards bend along them.
#include "saltus/solver/detail/line_states.hpp"

#include "support/run.hpp"

using namespace saltus;

namespace {

using Flow = std::function<double(double)>;

/// Finds the lines among states with these values in time, from u = 0 to 1.
bool find(LineStates& lines, const std::vector<Flow>& states) {
  const auto at = [&](double u, double* x) {
    for (std::size_t i = 0; i < states.size(); ++i) x[i] = states[i](u);
  };
  List<double> x(states.size(), 0.0);
  at(0.0, x.data());
  return lines.find(x, 0.0, thresholds::line_share, 1.0, at);
}
bool is_line(const Flow& state) {
  LineStates lines;
  return find(lines, {state});
}

}  // namespace

TEST_CASE("a state that moves as the time does is a line, one that bends or rests is none",
          "[line_states]") {
  CHECK(is_line([](double u) { return 3.0 - 2.0 * u; }));
  CHECK(is_line([](double u) { return 1e9 + u; }));  // to the rounding of 1e9
  CHECK_FALSE(is_line([](double u) { return u + 1e-10 * u * u; }));
  CHECK_FALSE(is_line([](double u) { return std::sin(u); }));
  CHECK_FALSE(is_line([](double) { return 3.0; }));
  CHECK_FALSE(is_line([](double u) { return 1.0 + 1e-13 * u; }));  // some roundings
}

TEST_CASE("only the lines move", "[line_states]") {
  LineStates lines;
  REQUIRE(find(lines, {[](double u) { return 2.0 * u; }, [](double u) { return 1.0 + u * u; }}));
  CHECK(lines.at(0)[0] == 2.0 * thresholds::line_share);
  CHECK(lines.at(1)[0] == 2.0);
  CHECK(lines.at(0)[1] == 1.0);
  CHECK(lines.at(1)[1] == 1.0);
}

TEST_CASE("a guard bends where its three values are on no line", "[line_states]") {
  const auto bends = [](double begin, const Flow& guard) {
    LineStates lines;
    const auto state = [begin](double u) { return begin + u; };
    REQUIRE(find(lines, {state}));
    return lines.bends(guard(state(0.0)), guard(lines.at(0)[0]), guard(lines.at(1)[0]));
  };
  CHECK(bends(0.0, [](double c) { return std::sin(c) - 0.5; }));
  CHECK(bends(0.0, [](double c) { return 1e-6 * c * c; }));
  CHECK_FALSE(bends(0.0, [](double c) { return 3.0 * c - 0.7; }));
  CHECK_FALSE(bends(0.0, [](double) { return 0.7; }));
  // What the rounding of the state explains is no bend.
  CHECK_FALSE(bends(1e9, [](double c) { return c - 1e9 - 0.3; }));
  CHECK(bends(1e9, [](double c) { return std::sin(c - 1e9); }));
  // A whole number of periods lies between two of the points.
  const double w = 2.0 * std::acos(-1.0);
  CHECK(bends(0.0, [w](double c) { return std::sin(w * c); }));
  CHECK(bends(0.0, [w](double c) { return std::sin(w * c / thresholds::line_share); }));
}
