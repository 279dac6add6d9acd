// MatrixConcatenation: the order of the entries, vectors in the place of matrices, and what does not
// fit.
#include "library_support.hpp"
#include "saltus/library/matrix_concatenation.hpp"
#include "saltus/library/matrix_transposition.hpp"

using namespace saltus;
using namespace library_test;

namespace {

MatrixByRows numbers(Index rows, Index columns, double first) {
  MatrixByRows made(rows, columns);
  for (Index i = 0; i < made.size(); ++i) made.data()[i] = first + static_cast<double>(i);
  return made;
}

Numbers entries(const MatrixByRows& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

Numbers joined(std::initializer_list<Value> inputs, int axis) {
  const std::vector<Value> all(inputs);
  return Bench<MatrixConcatenation>(all, static_cast<int>(all.size()), axis).output();
}

}  // namespace

TEST_CASE("matrices follow each other along an axis", "[library]") {
  for (const Index columns : {1, 2, 5}) {
    const MatrixByRows a = numbers(2, columns, 1.0), b = numbers(3, columns, 100.0);
    MatrixByRows below(5, columns), beside(columns, 5);
    below << a, b;
    beside << a.transpose(), b.transpose();
    CHECK(joined({a, b}, 0) == entries(below));
    CHECK(joined({MatrixByRows(a.transpose()), MatrixByRows(b.transpose())}, 1) == entries(beside));
  }
}

TEST_CASE("a vector is a row below others, and a column beside others", "[library]") {
  const MatrixByRows square = numbers(2, 2, 1.0);
  const Value vector{5.0, 6.0};
  CHECK(joined({square, vector}, 0) == Numbers{1, 2, 3, 4, 5, 6});
  CHECK(joined({square, vector}, 1) == Numbers{1, 2, 5, 3, 4, 6});
  CHECK(joined({vector, vector, vector}, 1) == Numbers{5, 5, 5, 6, 6, 6});
  CHECK(joined({1.0, 2.0}, 1) == Numbers{1, 2});
}

TEST_CASE("matrices that do not fit are refused by the shapes of two inputs", "[library]") {
  const Value tall = numbers(3, 2, 0.0), wide = numbers(2, 3, 0.0);
  CHECK(contains(model_error([&] { joined({tall, tall, wide}, 0); }),
                 "expected as many columns in all inputs, found shape (3, 2) at in_0 and shape "
                 "(2, 3) at in_2"));
  CHECK(contains(model_error([&] { joined({tall, wide}, 1); }), "as many rows in all inputs"));
  CHECK(contains(model_error([&] { joined({tall}, 2); }), "axis is 2; expected 0"));
}
