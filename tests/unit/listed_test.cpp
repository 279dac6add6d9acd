// Vectors in messages: short, exact, and cut after six numbers.
#include "saltus/base/detail/listed.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a vector is listed in brackets, in the shortest exact form of its numbers", "[listed]") {
  CHECK(listed(vec({10.0, -3.0})) == "[10, -3]");
  CHECK(listed(vec({0.1})) == "[0.1]");
  CHECK(listed(vec({not_a_number, -infinite})) == "[nan, -inf]");
  CHECK(listed(Eigen::VectorXd()) == "[]");
}

TEST_CASE("six numbers are listed whole, of seven the first six", "[listed]") {
  CHECK(listed(vec({1, 2, 3, 4, 5, 6})) == "[1, 2, 3, 4, 5, 6]");
  CHECK(listed(vec({1, 2, 3, 4, 5, 6, 7})) == "[1, 2, 3, 4, 5, 6, ...]");
}
