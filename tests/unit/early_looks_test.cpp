// EarlyLooks: whether looks within a short time show how a guard moves in it.
#include "saltus/simulation/detail/early_looks.hpp"

#include <functional>
#include <numbers>
#include <random>

#include "support/catch.hpp"

using saltus::EarlyLooks;

namespace {

/// Looks at g(s), where s is the part of the time.
EarlyLooks at(const std::function<double(double)>& g) {
  EarlyLooks looks{.start = g(0.0)};
  for (std::size_t i = 0; i < looks.after.size(); ++i) looks.after[i] = g(EarlyLooks::parts[i]);
  return looks;
}
/// Looks at a sine that turns by `angle` in the time.
EarlyLooks at_sine(double angle, double phase = 0.0) {
  return at([=](double s) { return std::sin(phase + angle * s) - std::sin(phase); });
}

}  // namespace

TEST_CASE("looks show a parabola, of any size", "[early_looks]") {
  const double scale = GENERATE(1e-200, 1.0, -1e200);
  CHECK(at([=](double s) { return scale * s; }).show());
  CHECK(at([=](double s) { return scale * s * s; }).show());
  CHECK(at([=](double s) {
          return scale * (s - s * s);
        }).show());  // by four ranges at its first slope
  CHECK(at([=](double s) { return scale * std::exp(s); }).show());
}

TEST_CASE("looks show a guard that is constant, also where it jumps at the start",
          "[early_looks]") {
  CHECK(at([](double) { return 2.0; }).show());
  CHECK(at([](double s) { return s > 0.0 ? 1.0 : -1.0; }).show());
  CHECK_FALSE(at([](double s) { return s > 0.3 ? 1.0 : -1.0; }).show());
}

TEST_CASE("looks show a sine while they are within half of its period", "[early_looks]") {
  CHECK(at_sine(0.25).show());
  CHECK(at_sine(0.5 * std::numbers::pi).show());
  for (double angle = 4.0; angle < 40.0; angle *= 1.01) {
    INFO(angle);
    CHECK_FALSE(at_sine(angle).show());
  }
}

/// A sine that turns by far more is random where it is looked at. The values of two looks are then within
/// a sixteenth of the range of a parabola in about (1/8)^2 of the cases, and the first slope within its
/// bound in an eighth of these.
TEST_CASE("looks that are too far apart seem to show a sine once in 500 times at most",
          "[early_looks]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int seen = 0;
  for (int i = 0; i < 100000; ++i)
    seen += at_sine(100.0 * std::pow(1e4, part(random)), 6.3 * part(random)).show();
  CHECK(seen <= 200);
}

TEST_CASE("a guard that comes back does not go one way", "[early_looks]") {
  const double sign = GENERATE(1.0, -1.0);
  CHECK(at([=](double s) { return sign * s; }).go_one_way());
  CHECK(at([=](double s) { return s > 0.0 ? sign : -sign; }).go_one_way());
  CHECK_FALSE(at([=](double s) { return sign * (s - s * s); }).go_one_way());
  CHECK_FALSE(at([=](double s) { return sign * (s - 0.6 * s * s); }).go_one_way());
  // Whose vertex is before the first look.
  CHECK(at([=](double s) { return sign * (s * s - 0.01 * s); }).go_one_way());
}
