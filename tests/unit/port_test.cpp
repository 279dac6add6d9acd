// Ports: shapes that follow from the inputs, and which entries of them an entry reads.
#include "saltus/model/port.hpp"

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("a scalar and a vector of one entry are two shapes", "[port]") {
  CHECK(Shape::scalar() != Shape::of(1));
  CHECK(Shape::of(3) == Shape{3, true});
  CHECK(Shape{} == Shape::scalar());
}

TEST_CASE("entry by entry the result is as wide as the widest input", "[port]") {
  const Shape one = Shape::scalar(), single = Shape::of(1), three = Shape::of(3);
  struct Row {
    std::vector<Shape> inputs;
    Shape result;
  };
  const Row rows[] = {{{}, one},
                      {{one, one}, one},
                      {{one, single}, single},
                      {{one, three, one}, three},
                      {{single, three}, three},
                      {{three, single}, three},
                      {{three, three}, three}};
  for (const Row& row : rows) CHECK(elementwise(row.inputs) == row.result);
}

TEST_CASE("entry i reads entry i of a vector and the only entry of a scalar", "[port]") {
  const std::vector<Index> widths{3, 1};
  for (Index i = 0; i < 3; ++i) {
    const EntryRange of_vector = entry_by_entry(i, 0, widths);
    const EntryRange of_scalar = entry_by_entry(i, 1, widths);
    CHECK((of_vector.first == i && of_vector.last == i + 1));
    CHECK((of_scalar.first == 0 && of_scalar.last == 1));
  }
}
