// is_defined: whether a function has a value at a point that the solution need not reach.
#include "saltus/base/detail/is_defined.hpp"

#include <stdexcept>

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("a call that throws has no value, whatever it throws", "[is_defined]") {
  int calls = 0;
  CHECK(detail::is_defined([&] { ++calls; }));
  CHECK_FALSE(detail::is_defined([&] { ++calls, throw std::domain_error("x"); }));
  CHECK_FALSE(detail::is_defined([&] { ++calls, throw 3; }));
  CHECK(calls == 3);
}

TEST_CASE("an interruption is no missing value", "[is_defined]") {
  CHECK_THROWS_AS(detail::is_defined([] { throw Interruption(); }), Interruption);
}
