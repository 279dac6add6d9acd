// SumOfElements, ProductOfElements, DotProduct, CrossProduct, Slice, ScalarBroadcast: values and
// shapes.
#include "library_support.hpp"
#include "saltus/library/cross_product.hpp"
#include "saltus/library/dot_product.hpp"
#include "saltus/library/product_of_elements.hpp"
#include "saltus/library/scalar_broadcast.hpp"
#include "saltus/library/slice.hpp"
#include "saltus/library/sum_of_elements.hpp"

using namespace saltus;
using namespace library_test;

namespace {

const Value four{10.0, 11.0, 12.0, 13.0};

Numbers sliced(const Slice::Range& range) { return Bench<Slice>({four}, range).output(); }

}  // namespace

TEST_CASE("the sum and the product of the entries are scalars", "[library]") {
  Bench<SumOfElements> sum({Value{1.0, 2.0, 4.0}});
  CHECK(sum.output() == Numbers{7.0});
  CHECK(sum.node().shape == Shape::scalar());
  CHECK(Bench<SumOfElements>({3.0}).output() == Numbers{3.0});
  CHECK(Bench<ProductOfElements>({Value{2.0, 3.0, -4.0}}).output() == Numbers{-24.0});
}

TEST_CASE("products of vectors", "[library]") {
  const Value a{1.0, 2.0, 3.0}, b{-4.0, 5.0, 6.0};
  Bench<DotProduct> dot({a, b});
  CHECK(dot.output() == Numbers{24.0});
  CHECK(dot.node().shape == Shape::scalar());
  CHECK(Bench<CrossProduct>({a, b}).output() == Numbers{-3.0, -18.0, 13.0});
  CHECK(Bench<CrossProduct>({a, a}).output() == Numbers{0.0, 0.0, 0.0});
  CHECK(contains(model_error([&] { Bench<DotProduct>({a, Value{1.0, 2.0}}); }),
                 "the inputs have the widths 3 and 2; expected two vectors of one width"));
  CHECK(contains(model_error([&] { Bench<CrossProduct>({a, 1.0}); }),
                 "expected shape (3,), found a scalar"));
}

TEST_CASE("Slice chooses entries as Python does", "[library]") {
  CHECK(sliced({}) == Numbers{10.0, 11.0, 12.0, 13.0});
  CHECK(sliced({.start = 1, .stop = 3}) == Numbers{11.0, 12.0});
  CHECK(sliced({.start = -3, .stop = 9}) == Numbers{11.0, 12.0, 13.0});
  CHECK(sliced({.step = 2}) == Numbers{10.0, 12.0});
  CHECK(sliced({.step = 3}) == Numbers{10.0, 13.0});
  CHECK(sliced({.start = 3, .step = -3}) == Numbers{13.0, 10.0});
  CHECK(sliced({.step = -1}) == Numbers{13.0, 12.0, 11.0, 10.0});
  CHECK(sliced({.start = 2, .stop = 0, .step = -1}) == Numbers{12.0, 11.0});
  CHECK(Bench<Slice>({four}, std::vector<Index>{3, 0, -1}).output() == Numbers{13.0, 10.0, 13.0});
}

TEST_CASE("one entry is a scalar, a list of one entry a vector", "[library]") {
  Bench<Slice> one({four}, Index{-2}), list({four}, std::vector<Index>{2});
  CHECK(one.output() == Numbers{12.0});
  CHECK(one.node().shape == Shape::scalar());
  CHECK(list.node().shape == Shape::of(1));
}

TEST_CASE("a Slice of entries that are not there is refused", "[library]") {
  CHECK(contains(model_error([] { Bench<Slice>({four}, Index{4}); }),
                 "there is no entry 4 of an input of width 4; expected -4 to 3"));
  CHECK(contains(model_error([] { sliced({.start = 3, .stop = 1}); }),
                 "no entry of an input of width 4 is chosen"));
  CHECK(contains(model_error([] { sliced({.step = 0}); }), "step = 0"));
  CHECK(contains(model_error([] { Slice("s", std::vector<Index>{}); }), "the list of entries is"));
}

TEST_CASE("ScalarBroadcast repeats a scalar", "[library]") {
  Bench<ScalarBroadcast> block({7.0}, 3);
  CHECK(block.output() == Numbers{7.0, 7.0, 7.0});
  CHECK(block.node().shape == Shape::of(3));
  CHECK(contains(model_error([] { ScalarBroadcast("b", 0); }), "expected 1 entry or more"));
}
