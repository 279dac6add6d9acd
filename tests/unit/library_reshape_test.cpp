// Reshape: the entries keep their order, and their number.
#include "library_support.hpp"
#include "saltus/library/matrix_multiplication.hpp"
#include "saltus/library/reshape.hpp"
#include "saltus/simulation/simulate.hpp"

using namespace saltus;
using namespace library_test;

TEST_CASE("a reshaped signal has the same entries row by row", "[library]") {
  const Value six{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  for (const Shape& shape : {Shape::matrix(2, 3), Shape::matrix(3, 2), Shape::of(6)}) {
    Bench<Reshape> bench({six}, shape);
    CHECK(bench.output() == Numbers{1, 2, 3, 4, 5, 6});
    CHECK(bench.node().rate == Rate::constant);
  }
  const MatrixByRows matrix{{1.0, 2.0}, {3.0, 4.0}};
  CHECK(Bench<Reshape>({matrix}, Shape::of(4)).output() == Numbers{1, 2, 3, 4});
  CHECK(Bench<Reshape>({Value{7.0}}, Shape::scalar()).output() == Numbers{7});
}

// A product takes its rule from the shapes of its wires: (2 x 3)(3) is a vector of 2.
TEST_CASE("blocks behind a Reshape see a matrix", "[library]") {
  DiagramBuilder builder;
  auto& a = builder.add<Constant>("a", Value{1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  auto& shaped = builder.add<Reshape>("shaped", Shape::matrix(2, 3));
  auto& b = builder.add<Constant>("b", Value{1.0, 0.0, -1.0});
  auto& product = builder.add<MatrixMultiplication>("product");
  builder.connect(a.output(), shaped.input());
  builder.connect(shaped.output(), product.input(0));
  builder.connect(b.output(), product.input(1));
  const Diagram diagram = builder.build();
  const Results results = simulate(diagram, diagram.create_context(), {0.0, 1.0},
                                   {.recorded_signals = {{"y", product.output()}}});
  CHECK(results.output("y").row(0) == Eigen::RowVector2d(-2.0, -2.0));
}

TEST_CASE("another number of entries is refused by both shapes", "[library]") {
  CHECK(contains(model_error([] { Bench<Reshape>({Value{1.0, 2.0}}, Shape::matrix(2, 3)); }),
                 "expected 6 entries for shape (2, 3), found shape (2,)"));
  CHECK(contains(model_error([] { Reshape("r", Shape::of(0)); }), "at least one entry"));
}
