// Signals of two dimensions: which shapes fit, how blocks combine them, and what a callback sees.
#include <string>
#include <vector>

#include <Eigen/LU>

#include "library_support.hpp"
#include "saltus/model/shape.hpp"
#include "saltus/simulation/evaluate.hpp"
#include "saltus/simulation/linearize.hpp"
#include "saltus/simulation/simulate.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

/// Whole numbers, so that sums and products are exact.
Eigen::MatrixXd whole(Index rows, Index columns, double first) {
  Eigen::MatrixXd m(rows, columns);
  for (Index i = 0; i < m.size(); ++i)
    m(i / columns, i % columns) = std::fmod(first + 5.0 * static_cast<double>(i), 13.0) - 6.0;
  return m;
}

/// The only output of a block between constants, as a matrix.
template <class Block, class... Arguments>
Eigen::MatrixXd out(const std::vector<Value>& inputs, Arguments&&... arguments) {
  Bench<Block> bench(inputs, std::forward<Arguments>(arguments)...);
  const Numbers values = bench.output();
  const Shape shape = bench.node().shape;
  return MatrixView(values.data(), shape.rows(), std::max(shape.columns, Index{1}));
}

template <class Block, class... Arguments>
Shape shape_of(const std::vector<Value>& inputs, Arguments&&... arguments) {
  return Bench<Block>(inputs, std::forward<Arguments>(arguments)...).node().shape;
}

}  // namespace

TEST_CASE("a shape says its dimensions, and the places of its entries row by row", "[shape]") {
  const Shape matrix = Shape::matrix(2, 3);
  CHECK((matrix.size == 6 && matrix.rows() == 2 && matrix.columns == 3 && matrix.is_matrix()));
  CHECK((Shape::of(6).rows() == 6 && !Shape::of(6).is_matrix() && !Shape::scalar().is_matrix()));
  CHECK(to_string(matrix) == "(2, 3)");
  CHECK(to_string(Shape::of(3)) == "(3,)");
  CHECK(to_string(Shape::scalar()) == "a scalar");
  CHECK((in_words(matrix) == "shape (2, 3)" && in_words(Shape::scalar()) == "a scalar"));
  CHECK((entry_place(matrix, 4) == "[1,1]" && entry_place(Shape::of(6), 4) == "[4]"));
  CHECK(entry_place(Shape::scalar(), 0).empty());
}

TEST_CASE("a place is no larger for knowing the columns of a matrix", "[shape]") {
  CHECK(sizeof(Place) == 3 * sizeof(Index));
}

TEST_CASE("a port takes a signal of its shape; one entry fits a scalar port", "[shape]") {
  const Shape scalar = Shape::scalar(), single = Shape::of(1), six = Shape::of(6);
  const Shape flat = Shape::matrix(1, 1), wide = Shape::matrix(2, 3), tall = Shape::matrix(3, 2);
  struct Row {
    Shape port, signal;
    bool fits;
  };
  const Row rows[] = {{scalar, scalar, true}, {scalar, single, true}, {scalar, flat, true},
                      {scalar, six, false},   {single, scalar, true}, {single, single, true},
                      {single, flat, false},  {six, six, true},       {six, scalar, false},
                      {six, wide, false},     {wide, wide, true},     {wide, tall, false},
                      {wide, six, false},     {wide, scalar, false},  {flat, flat, true},
                      {flat, single, false},  {flat, scalar, false}};
  for (const Row& row : rows) {
    INFO(to_string(row.port) << " takes " << to_string(row.signal));
    CHECK(takes(row.port, row.signal) == row.fits);
  }
  CHECK(InputDeclaration{}.takes(wide));
  CHECK(InputDeclaration{.shape = wide, .flat = true}.takes(six));
  CHECK_FALSE(InputDeclaration{.shape = wide, .flat = true}.takes(tall));
}

TEST_CASE("elementwise blocks keep the shape of a matrix", "[shape]") {
  const Eigen::MatrixXd a = whole(2, 3, 1.0), b = whole(2, 3, 4.0);
  CHECK(out<Adder>({a, b}, "+-") == a - b);
  CHECK(out<Product>({a, b, 2.0}, "***") == 2.0 * a.cwiseProduct(b));
  CHECK(out<Gain>({a}, -3.0) == -3.0 * a);
  CHECK(out<Gain>({2.0}, a) == 2.0 * a);
  CHECK(out<Abs>({a}) == a.cwiseAbs());
  CHECK(out<Offset>({a}, b) == a + b);
  CHECK(out<Saturate>({a}, SaturateOptions{.lower_limit = -2.0, .upper_limit = 3.0}) ==
        a.cwiseMax(-2.0).cwiseMin(3.0));
  CHECK(out<Switch>({a, 1.0, b}, SwitchOptions{}) == a);
  CHECK(out<MinMax>({a, b}, "max", 2) == a.cwiseMax(b));
  for (const Shape& shape :
       {shape_of<Adder>({a, 1.0}, "++"), shape_of<Gain>({Value{1.0}}, a),
        shape_of<UnitDelay>({a}, 0.1, UnitDelayOptions{.initial_state = b}),
        shape_of<ZeroOrderHold>({a}, 0.1, ZeroOrderHoldOptions{.initial_state = b}),
        shape_of<Integrator>({a}, IntegratorOptions{.initial_state = b})})
    CHECK(shape == Shape::matrix(2, 3));
}

// The rule of NumPy for A @ B, with every combination of vectors and matrices.
TEST_CASE("a product has the shape and the entries of Eigen's", "[shape]") {
  const Eigen::MatrixXd a = whole(2, 3, 1.0), b = whole(3, 4, 2.0);
  const Eigen::VectorXd two = whole(2, 1, 3.0), three = whole(3, 1, 5.0);
  const auto product = [](const Value& left, const Value& right) {
    return out<MatrixMultiplication>({left, right});
  };
  const auto shape = [](const Value& left, const Value& right) {
    return shape_of<MatrixMultiplication>({left, right});
  };
  CHECK(product(a, b) == a * b);
  CHECK(product(a, three) == a * three);
  CHECK(product(two, a).transpose() == two.transpose() * a);
  CHECK(product(three, three)(0) == three.dot(three));
  CHECK(shape(a, b) == Shape::matrix(2, 4));
  CHECK(shape(a, three) == Shape::of(2));
  CHECK(shape(two, a) == Shape::of(3));
  CHECK(shape(three, three) == Shape::scalar());
  CHECK(shape(Eigen::MatrixXd(three), Eigen::MatrixXd(three.transpose())) == Shape::matrix(3, 3));
}

TEST_CASE("transposes and inverses take the shapes of their wires", "[shape]") {
  const Eigen::MatrixXd a = whole(2, 3, 1.0);
  CHECK(out<MatrixTransposition>({a}) == a.transpose());
  Eigen::MatrixXd m(3, 3);
  m << 0, 2, 1, 1, -1, 3, 4, 0, 2;
  // As in library_matrices_test: the condition is below 10, with some 3 n roundings of an entry.
  CHECK((out<MatrixInversion>({m}) * m - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff() <
        1e-14);
}

TEST_CASE("blocks of vectors flatten a matrix, sum it or refuse it", "[shape]") {
  const Eigen::MatrixXd a = whole(2, 3, 1.0);
  CHECK(out<Multiplexer>({a}, 1) == a.reshaped<Eigen::RowMajor>());
  CHECK(shape_of<Multiplexer>({a, 1.0}, 2) == Shape::of(7));
  CHECK(out<SumOfElements>({a})(0) == a.sum());
  for (const std::string& said : {model_error([&] { Bench<Slice>({a}, Index{0}); }),
                                  model_error([&] { Bench<Demultiplexer>({a}, 2); }),
                                  model_error([&] { Bench<DotProduct>({a, a}); })})
    CHECK(contains(said,
                   "block 'block': expected a vector, found shape (2, 3); a Multiplexer of "
                   "one input gives the entries of a matrix as a vector"));
}

TEST_CASE("what does not fit is refused with both shapes", "[shape]") {
  const Eigen::MatrixXd a = whole(2, 3, 1.0), turned = a.transpose();
  const Value six{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  CHECK(contains(model_error([&] { Bench<Adder>({a, turned}, "++"); }),
                 "expected scalars and signals of one shape, found the shapes (2, 3), (3, 2)"));
  CHECK(contains(model_error([&] { Bench<Adder>({a, six}, "++"); }), "(2, 3), (6,)"));
  CHECK(contains(model_error([&] { Bench<Gain>({six}, a); }), "(2, 3), (6,)"));
  CHECK(contains(model_error([&] { Bench<MatrixMultiplication>({a, a}); }),
                 "as many columns on the left as rows on the right, found shape (2, 3) and shape "
                 "(2, 3)"));
  CHECK(contains(model_error([&] { Bench<MatrixMultiplication>({a, 2.0}); }),
                 "found shape (2, 3) and a scalar; a Gain or a Product multiplies by a scalar"));
  CHECK(contains(model_error([&] { Bench<MatrixTransposition>({six}); }),
                 "expected a matrix, found shape (6,)"));
  CHECK(contains(model_error([&] { Bench<MatrixInversion>({a}); }),
                 "expected a square matrix, found shape (2, 3)"));
  CHECK(model_error([&] { Bench<Integrator>({turned}, IntegratorOptions{.initial_state = a}); }) ==
        "input 'in' of block 'block': expected shape (2, 3), found shape (3, 2) from output "
        "'u0.out'");
  CHECK(contains(
      model_error([&] { Bench<Integrator>({a}, IntegratorOptions{.initial_state = six}); }),
      "expected shape (6,), found shape (2, 3) from output 'u0.out'; a Multiplexer of "
      "one input gives the entries"));
}

TEST_CASE("a limit of a matrix is one number or has its shape", "[shape]") {
  const Eigen::MatrixXd a = whole(2, 3, 1.0), below = a.array() - 20.0, turned = a.transpose();
  const auto limited = [&](const Value& limit) {
    Integrator("i", {.initial_state = a, .enable_limits = true, .lower_limit = limit});
  };
  CHECK_NOTHROW(limited(below));
  CHECK_NOTHROW(limited(-20.0));
  CHECK(
      model_error([&] { limited(turned); }) ==
      "block 'i': a limit has the shape (3, 2), initial_state shape (2, 3); expected one value or "
      "this shape");
  CHECK(contains(
      model_error([&] { Derivative("d", {.filter_coefficient = turned, .initial_state = a}); }),
      "filter_coefficient has the shape (3, 2)"));
  CHECK(contains(model_error([&] {
                   SecondOrderIntegrator("s", {.initial_position = a, .initial_velocity = turned});
                 }),
                 "initial_velocity has the shape (3, 2)"));
}

namespace {

/// Y = U^T of a 2 x 3 matrix, by a callback that sees matrices.
class Turn final : public LeafSystem {
 public:
  Turn() : LeafSystem("turn") {
    declare_input_port({.name = "u", .shape = Shape::matrix(2, 3)});
    declare_output_port(
        {.name = "y",
         .calc = [](const At& at, VectorRef y) { by_rows(y, 2) = at.u.matrix(0).transpose(); },
         .shape = Shape::matrix(3, 2),
         .reads = Reads::inputs});
  }
};

/// R' = R W, for a matrix W.
Diagram turning(const Eigen::MatrixXd& w) {
  DiagramBuilder builder;
  auto& rate = builder.add<Constant>("w", w);
  auto& product = builder.add<MatrixMultiplication>("product");
  auto& r = builder.add<Integrator>(
      "r", IntegratorOptions{.initial_state = Eigen::MatrixXd::Identity(3, 3)});
  builder.connect(r.output(), product.input(0));
  builder.connect(rate.output(), product.input(1));
  builder.connect(product.output(), r.input());
  builder.export_output(r.output(), "R");
  return builder.build();
}

}  // namespace

TEST_CASE("a callback reads and writes matrices; a fixed input may be one", "[shape]") {
  Turn turn;
  const Eigen::MatrixXd a = whole(2, 3, 1.0);
  turn.fix_input(0, a);
  const SignalValue y = evaluate_output(turn, turn.output(), turn.create_context());
  CHECK(y.shape == Shape::matrix(3, 2));
  CHECK(MatrixView(y.values.data(), 3, 2) == a.transpose());
  turn.fix_input(0, Eigen::MatrixXd(a.transpose()));
  CHECK(contains(model_error([&] { compile(turn); }),
                 "input 'u' of block 'turn': expected shape (2, 3), found shape (3, 2) from its "
                 "fixed value"));
}

// R(t) = exp(W t) turns by |w| t about w = (0, 0, 1): the closed form of Rodrigues.
TEST_CASE("a rotation follows its differential equation of matrices", "[shape]") {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(3, 3);
  w(0, 1) = -1.0, w(1, 0) = 1.0;
  const Diagram diagram = turning(w);
  const Results results =
      simulate(diagram, diagram.create_context(), {0.0, 2.0},
               {.rtol = 1e-10, .atol = 1e-12, .recorded_signals = {{"R", diagram.output()}}});
  CHECK(results.signals[0].shape == Shape::matrix(3, 3));
  const double c = std::cos(2.0), s = std::sin(2.0);
  const double expected[] = {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0};
  const Eigen::VectorXd end = results.output("R").bottomRows(1).transpose();
  // A flow that only turns adds up the errors of its steps, some 30 of rtol each at most.
  for (Index i = 0; i < 9; ++i) CHECK_THAT(end[i], WithinAbs(expected[i], 30 * 1e-10));
}

TEST_CASE("a linearisation names the entries of matrices by row and column", "[shape]") {
  Turn turn;
  const Linearization found =
      linearize(turn, turn.create_context(), {.inputs = {{"u", MatrixByRows(whole(2, 3, 1.0))}}});
  CHECK(found.inputs ==
        std::vector<std::string>{"u[0,0]", "u[0,1]", "u[0,2]", "u[1,0]", "u[1,1]", "u[1,2]"});
  CHECK(found.outputs ==
        std::vector<std::string>{"y[0,0]", "y[0,1]", "y[1,0]", "y[1,1]", "y[2,0]", "y[2,1]"});
  // y[0,1] is u[1,0]; Turn is called, so differences give D, exact to the roundings of whole
  // numbers over a step of about 1e-5.
  CHECK_THAT(found.D(1, 3), WithinAbs(1.0, 1e-9));
  CHECK_THAT(found.D(1, 0), WithinAbs(0.0, 1e-9));
}
