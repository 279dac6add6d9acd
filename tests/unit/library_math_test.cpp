// Adder, Gain, Offset, Product, Abs, Saturate, Multiplexer, Demultiplexer and function blocks:
// values and shapes.
#include "library_support.hpp"

using namespace saltus;
using namespace library_test;

TEST_CASE("Adder adds and subtracts, a scalar stretched to the width of a vector", "[library]") {
  CHECK(Bench<Adder>({5.0, 3.0}, "+-").output() == Numbers{2.0});
  CHECK(Bench<Adder>({5.0}, "-").output() == Numbers{-5.0});
  Bench<Adder> sum({1.0, Value{10.0, 20.0}, 2.0}, "-++");
  CHECK(sum.output() == Numbers{11.0, 21.0});
  CHECK(sum.node().shape == Shape::of(2));
  CHECK(sum.node().rate == Rate::constant);
}

TEST_CASE("Product multiplies and divides", "[library]") {
  CHECK(Bench<Product>({6.0, 3.0}, "*/").output() == Numbers{2.0});
  CHECK(Bench<Product>({4.0}, "/").output() == Numbers{0.25});
  CHECK(Bench<Product>({Value{1.0, 2.0}, 3.0, Value{2.0, 4.0}}, "***").output() ==
        Numbers{6.0, 24.0});
}

TEST_CASE("Gain and Offset take a number or a vector", "[library]") {
  CHECK(Bench<Gain>({3.0}, -0.5).output() == Numbers{-1.5});
  CHECK(Bench<Gain>({Value{1.0, 2.0}}, 3.0).output() == Numbers{3.0, 6.0});
  CHECK(Bench<Gain>({2.0}, Eigen::Vector2d(1.0, 5.0)).output() == Numbers{2.0, 10.0});
  CHECK(Bench<Offset>({3.0}, 1.5).output() == Numbers{4.5});
  CHECK(Bench<Offset>({Value{1.0, 2.0}}, Value{10.0, 20.0}).output() == Numbers{11.0, 22.0});
}

TEST_CASE("a vector of one entry stays a vector, a scalar a scalar", "[library]") {
  CHECK(Bench<Gain>({2.0}, 3.0).node().shape == Shape::scalar());
  CHECK(Bench<Gain>({Value{2.0}}, 3.0).node().shape == Shape::of(1));
}

TEST_CASE("Abs is |u|", "[library]") {
  CHECK(Bench<Abs>({Value{-2.0, 0.0, 3.0}}).output() == Numbers{2.0, 0.0, 3.0});
}

TEST_CASE("Saturate clips below, above or on both sides", "[library]") {
  const std::vector<Value> u{Value{-2.0, -1.0, 0.0, 1.0, 2.0}};
  CHECK(Bench<Saturate>(u, Saturate::Options{.lower_limit = -1.0, .upper_limit = 1.0}).output() ==
        Numbers{-1.0, -1.0, 0.0, 1.0, 1.0});
  CHECK(Bench<Saturate>(u, Saturate::Options{.lower_limit = 0.5}).output() ==
        Numbers{0.5, 0.5, 0.5, 1.0, 2.0});
  CHECK(Bench<Saturate>({7.0}, Saturate::Options{.upper_limit = Value{3.0, 9.0}}).output() ==
        Numbers{3.0, 7.0});
  CHECK(Bench<Saturate>({Value{7.0, 8.0}}, Saturate::Options{.upper_limit = Value{7.5}}).output() ==
        Numbers{7.0, 7.5});
}

TEST_CASE("Multiplexer joins, Demultiplexer cuts", "[library]") {
  Bench<Multiplexer> join({1.0, Value{2.0, 3.0}, 4.0}, 3);
  CHECK(join.output() == Numbers{1.0, 2.0, 3.0, 4.0});
  CHECK(join.node().shape == Shape::of(4));
  Bench<Demultiplexer> scalars({Value{1.0, 2.0}}, 2), parts({Value{1.0, 2.0, 3.0, 4.0}}, 2);
  CHECK(scalars.output(1) == Numbers{2.0});
  CHECK(scalars.node(1).shape == Shape::scalar());
  CHECK(parts.output(0) == Numbers{1.0, 2.0});
  CHECK(parts.output(1) == Numbers{3.0, 4.0});
}

TEST_CASE("ReduceBlock calls a function over scalars or over whole inputs", "[library]") {
  const auto below = [](std::span<const double> u) { return u[0] < u[1]; };
  Bench<ReduceBlock> truth({1.0, 2.0}, 2, below);
  CHECK(truth.output() == Numbers{1.0});
  CHECK(truth.node().boolean);
  Bench<ReduceBlock> dot({Value{1.0, 2.0}, Value{3.0, 4.0}}, 2,
                         [](const Inputs& u) { return u[0].dot(u[1]); });
  CHECK(dot.output() == Numbers{11.0});
  CHECK_FALSE(dot.node().boolean);
  const auto twist = [](const Inputs& u) { return Eigen::VectorXd{u[0].reverse()}; };
  CHECK(Bench<ReduceBlock>({Value{1.0, 2.0}}, 1, twist, ReduceBlock::Options{.shape = Shape::of(2)})
            .output() == Numbers{2.0, 1.0});
}

TEST_CASE("FunctionBlock maps each entry", "[library]") {
  CHECK(Bench<FunctionBlock>({Value{1.0, -3.0}}, [](double u) { return u * u; }).output() ==
        Numbers{1.0, 9.0});
  Bench<FunctionBlock> sign({Value{1.0, -3.0}}, [](double u) { return u > 0.0; });
  CHECK(sign.output() == Numbers{1.0, 0.0});
  CHECK(sign.node().boolean);
}

TEST_CASE("vectors of different widths are refused, with the block's name and the widths",
          "[library]") {
  const Value two{1.0, 2.0}, three{1.0, 2.0, 3.0};
  CHECK(model_error([&] { Bench<Adder>({two, three}, "++"); }) ==
        "block 'block': expected scalars and signals of one shape, found the shapes (2,), (3,); "
        "bring them to one shape, "
        "for example with a Multiplexer");
  CHECK(contains(model_error([&] { Bench<Gain>({two}, three); }), "found the shapes (3,), (2,)"));
  CHECK(contains(
      model_error([&] { Bench<Saturate>({two}, Saturate::Options{.upper_limit = three}); }),
      "shapes (3,), (2,)"));
  CHECK(contains(model_error([&] { Bench<Demultiplexer>({three}, 2); }),
                 "width 3 cannot be cut into 2 equal parts"));
}

TEST_CASE("bad arguments of math blocks say what to write instead", "[library]") {
  CHECK(model_error([] { Adder("sum", "+*"); }) ==
        "block 'sum': unknown operator '*' in '+*'; expected one '+' or '-' for each input, as in "
        "\"++-\"; a Product takes "
        "'*' and '/'");
  CHECK(contains(model_error([] { Product("ratio", "+"); }), "an Adder takes '+' and '-'"));
  CHECK(model_error([] { Adder("sum", ""); }) ==
        "block 'sum': expected 1 operator or more, found 0");
  CHECK(contains(model_error([] { Saturate("s", {.lower_limit = 2.0, .upper_limit = 1.0}); }),
                 "lower_limit 2 is above upper_limit 1"));
  CHECK(contains(model_error([] { Saturate("s", {}); }), "give lower_limit, upper_limit or both"));
  CHECK(contains(model_error([] { Multiplexer("m", 0); }), "expected 1 input or more, found 0"));
  CHECK(
      contains(model_error([] { Demultiplexer("m", -1); }), "expected 1 output or more, found -1"));
  CHECK(contains(model_error([] { Constant("c", Eigen::VectorXd()); }), "empty vector"));
  CHECK(contains(
      model_error([] { ReduceBlock("r", 33, [](std::span<const double>) { return 0.0; }); }),
      "at most 32 inputs, found 33; write it over `const Inputs&`"));
}

TEST_CASE("a ReduceBlock whose vector has another width than it said ends with its name",
          "[library]") {
  const auto three = [](const Inputs&) { return Eigen::VectorXd{Eigen::VectorXd::Ones(3)}; };
  Bench<ReduceBlock> wrong({1.0}, 1, three, ReduceBlock::Options{.shape = Shape::of(2)});
  CHECK(model_error([&] { wrong.output(); }) ==
        "block 'block': expected 2 values from its function, found 3; say the width in "
        "Options::shape");
}
