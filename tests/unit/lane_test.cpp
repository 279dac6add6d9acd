// Lanes: one entry or two at once, with the same results, in the order of the state.
#include "saltus/solver/detail/lane.hpp"

#include "support/catch.hpp"

using namespace saltus;
using namespace saltus::detail;

namespace {

/// The first entries that for_lanes visits.
template <int W, int N>
std::vector<Index> visited(Index n) {
  std::vector<Index> all;
  for_lanes<W, N>(n, [&](Index i) { all.push_back(i); });
  return all;
}

}  // namespace

TEST_CASE("a lane of one or of two is loaded, stored and zero", "[lane]") {
  const double from[] = {1.5, -2.5, 3.5};
  double to[] = {9.0, 9.0, 9.0};
  store<0>(to, load<0>(from + 1));
  CHECK((to[0] == -2.5 && to[1] == 9.0));
  store<2>(to + 1, load<2>(from + 1));
  CHECK((to[0] == -2.5 && to[1] == -2.5 && to[2] == 3.5));
  store<2>(to, zero<2>());
  CHECK((to[0] == 0.0 && to[1] == 0.0 && to[2] == 3.5));
  CHECK(zero<0>() == 0.0);
}

TEST_CASE("a state is visited once, entry by entry or as one lane", "[lane]") {
  CHECK(visited<0, 0>(3) == std::vector<Index>{0, 1, 2});
  CHECK(visited<0, 3>(3) == std::vector<Index>{0, 1, 2});
  CHECK(visited<2, 2>(2) == std::vector<Index>{0});
  CHECK(visited<0, 0>(0).empty());
}

TEST_CASE("only two states that are called go two by two", "[lane]") {
  CHECK(called_width<1> == 0);
  CHECK(called_width<2> == 2);
  CHECK(called_width<4> == 0);
}

TEST_CASE("sizes and squares are those of the entries", "[lane]") {
  CHECK(larger(-3.0, 2.0) == 3.0);
  CHECK(larger(1.0, -2.0) == 2.0);
  CHECK(sum_of_squares(-3.0) == 9.0);
  const Eigen::Array2d a(-3.0, 1.0), b(2.0, -4.0);
  CHECK((larger(a, b)[0] == 3.0 && larger(a, b)[1] == 4.0));
  CHECK(sum_of_squares(a) == 10.0);
}

TEST_CASE("columns have room for their states, known at compile time or not", "[lane]") {
  Columns<0, 3> any(4);
  Columns<4, 3> known(4);
  for (double* data : {any.data(), known.data()}) {
    for (int i = 0; i < 12; ++i) CHECK(data[i] == 0.0);
    data[11] = 1.0;
  }
  CHECK(static_cast<const Columns<0, 3>&>(any).data()[11] == 1.0);
}
