// Guards that touch zero, stay at zero, or cross it twice in a step; scale and direction.
#include "support/watcher.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

const double pi = std::acos(-1.0);

}  // namespace

TEST_CASE("a guard that touches zero from above does not fire", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // sin t - 1 touches zero from below at pi/2 + 2 pi k; 1 - sin t from above. In doubles sin never
  // passes 1.
  CHECK(hits(watcher([](const At& at) { return std::sin(at.time) - 1.0 - 1e-9; }), 20.0, method)
            .empty());
  CHECK(hits(watcher([](const At& at) { return 1.0 + 1e-9 - std::sin(at.time); }), 20.0, method)
            .empty());
  CHECK(hits(watcher([](const At& at) { return 1.0 - std::sin(at.x[0]); },
                     Direction::negative_then_non_negative),
             20.0, method)
            .empty());
}

TEST_CASE(
    "a guard on a plateau of zeros fires on reaching it, not on it, not on leaving it to its "
    "armed "
    "side",
    "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // Falls to 0 at 1, stays until 2, then rises again or goes on down.
  const auto back = watcher(
      [](const At& at) { return std::max(1.0 - at.x[0], 0.0) + std::max(at.x[0] - 2.0, 0.0); },
      Direction::positive_then_non_positive);
  CHECK(hits(back, 3.0, method, 0.1).size() == 1);
  const auto flat = watcher([](const At&) { return 0.0; });
  CHECK(hits(flat, 3.0, method).empty());
}

TEST_CASE("a monotone guard fires once in its direction and never against it", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto rising = [](const At& at) { return at.x[0] - 0.7; };
  CHECK(hits(watcher(rising, Direction::negative_then_non_negative), 2.0, method).size() == 1);
  CHECK(hits(watcher(rising, Direction::positive_then_non_positive), 2.0, method).empty());
  CHECK(hits(watcher(rising, Direction::none), 2.0, method).empty());
  CHECK(hits(watcher(rising, Direction::crosses_zero), 2.0, method).size() == 1);
}

TEST_CASE("every zero of a sine is found, in each direction its half", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto sine = [](const At& at) { return std::sin(2.0 * at.x[0]); };
  const auto up = hits(watcher(sine, Direction::negative_then_non_negative), 10.0, method, 0.5);
  const auto down = hits(watcher(sine, Direction::positive_then_non_positive), 10.0, method, 0.5);
  REQUIRE(up.size() == 4);  // at zero at the start, and going up: contact
  REQUIRE(down.size() == 3);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK_THAT(up[k], WithinAbs(pi * static_cast<double>(k), 1e-9));
  for (std::size_t k = 0; k < 3; ++k)
    CHECK_THAT(down[k], WithinAbs(pi * (static_cast<double>(k) + 0.5), 1e-9));
}

TEST_CASE("two crossings inside one step are found where an interior point lies between them",
          "[laws][guards]") {
  const auto method = GENERATE(Method::dopri5, Method::automatic);
  INFO("method " << method);
  // x' = 1 lets steps grow to the end; the guard dips below zero between 0.45 and 0.8 of a step of
  // length 1.
  const auto dip = watcher([](const At& at) { return (at.x[0] - 0.45) * (at.x[0] - 0.8); });
  const auto found = hits(dip, 1.0, method);
  REQUIRE(found.size() == 2);
  CHECK_THAT(found[0], WithinAbs(0.45, 1e-12));
  CHECK_THAT(found[1], WithinAbs(0.8, 1e-12));
}

TEST_CASE("edge detection fires at every change of a stepwise value", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto found =
      hits(watcher([](const At& at) { return std::floor(at.x[0]); }, Direction::edge_detection),
           3.5, method, 0.4);
  REQUIRE(found.size() == 3);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK_THAT(found[k], WithinAbs(static_cast<double>(k + 1), 1e-12));
}
