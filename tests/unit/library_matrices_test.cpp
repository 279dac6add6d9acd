// MatrixMultiplication, MatrixTransposition, MatrixInversion: their laws, the order of the entries, and
// matrices that have no inverse.
#include "library_support.hpp"
#include "saltus/library/matrix_inversion.hpp"
#include "saltus/library/matrix_multiplication.hpp"
#include "saltus/library/matrix_transposition.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

using Shape2 = MatrixShape;

Value signal(const Numbers& entries) {
  return Eigen::VectorXd(Eigen::VectorXd::Map(entries.data(), static_cast<Index>(entries.size())));
}

Numbers product(const Numbers& a, Shape2 left, const Numbers& b, Shape2 right) {
  return Bench<MatrixMultiplication>({signal(a), signal(b)}, left, right).output();
}
Numbers transposed(const Numbers& a, Shape2 shape) {
  return Bench<MatrixTransposition>({signal(a)}, shape).output();
}
Numbers inverse(const Numbers& a, Index rows) {
  return Bench<MatrixInversion>({signal(a)}, rows).output();
}

const Numbers a{1, 2, 3, 4, 5, 6};                     // 2 x 3
const Numbers b{1, 0, -1, 2, 3, 1, 0, 2, 1, 1, 4, 5};  // 3 x 4
const Numbers c{2, 1, -3, 4};                          // 4 x 1

}  // namespace

// All entries are whole numbers below 2^53, so that every sum is exact.
TEST_CASE("products of matrices are associative, and have their entries row by row", "[library]") {
  CHECK(product(a, {2, 3}, b, {3, 4}) == Numbers{10, 5, 11, 21, 25, 11, 20, 48});
  CHECK(product(product(a, {2, 3}, b, {3, 4}), {2, 4}, c, {4, 1}) ==
        product(a, {2, 3}, product(b, {3, 4}, c, {4, 1}), {3, 1}));
  CHECK(product(a, {1, 6}, a, {6, 1}) == Numbers{91});
  CHECK(product({2}, {1, 1}, a, {1, 6}) == Numbers{2, 4, 6, 8, 10, 12});
}

TEST_CASE("a matrix transposed twice is itself, and (A B)^T = B^T A^T", "[library]") {
  CHECK(transposed(a, {2, 3}) == Numbers{1, 4, 2, 5, 3, 6});
  CHECK(transposed(transposed(b, {3, 4}), {4, 3}) == b);
  CHECK(transposed(product(a, {2, 3}, b, {3, 4}), {2, 4}) ==
        product(transposed(b, {3, 4}), {4, 3}, transposed(a, {2, 3}), {3, 2}));
}

// The entry (0, 0) is zero: without pivoting there is no factorisation.
TEST_CASE("a matrix times its inverse is the identity", "[library]") {
  const Numbers m{0, 2, 1, 1, -1, 3, 4, 0, 2};
  const Numbers unit = product(m, {3, 3}, inverse(m, 3), {3, 3});
  // |A| |A^-1| is below 10, and there are some 3 n roundings of each entry: 10 * 9 * 1.1e-16.
  for (std::size_t i = 0; i < 9; ++i) CHECK_THAT(unit[i], WithinAbs(i % 4 == 0 ? 1.0 : 0.0, 1e-14));
  CHECK(inverse({4.0}, 1) == Numbers{0.25});
}

TEST_CASE("a matrix without an inverse ends the run with its block and time", "[library]") {
  const auto message = [](const Numbers& entries, Index rows) {
    try {
      inverse(entries, rows);
    } catch (const SimulationError& error) {
      CHECK(error.block() == "block");
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK(contains(message({1, 2, 2, 4}, 2), "block 'block' has no inverse"));
  CHECK(contains(message({0}, 1), "t = 0 s"));
  CHECK(inverse({1e-200, 0, 0, 1e-200}, 2) ==
        Numbers{1e200, 0, 0, 1e200});  // small is not singular
}

TEST_CASE("shapes of matrices that do not fit are refused", "[library]") {
  CHECK(contains(
      model_error([] { MatrixMultiplication("m", {2, 3}, {2, 3}); }),
      "left is 2 x 3 and right is 2 x 3; expected as many columns of left as rows of right"));
  CHECK(contains(model_error([] { MatrixTransposition("m", {0, 3}); }), "at least one row"));
  CHECK(contains(model_error([] { MatrixInversion("m", -1); }), "at least one row"));
  CHECK(contains(model_error([] { product(a, {3, 3}, b, {3, 4}); }),
                 "expected shape (3, 3), found shape (6,)"));
}
