// text, quoted_list, known_names and the three kinds of errors.
#include "saltus/base/error.hpp"
#include "support/run.hpp"

using namespace saltus;

TEST_CASE("text writes numbers in their shortest exact form, and truths as words", "[error]") {
  CHECK(text("t = ", 0.1, " s") == "t = 0.1 s");
  CHECK(text(1.0 / 3.0) == "0.3333333333333333");
  CHECK(text(1e300, " ", -0.0, " ", 100.0) == "1e+300 -0 100");
  CHECK(text(3, " of ", std::size_t{7}, " ", -2L) == "3 of 7 -2");
  CHECK(text(true, " ", false) == "true false");
  CHECK(text(support::infinite, " ", support::not_a_number) == "inf nan");
  CHECK(text(std::string("a"), std::string_view("b"), "c") == "abc");
  CHECK(text() == "");
}

TEST_CASE("a list of names is quoted, and cut after twelve", "[error]") {
  CHECK(quoted_list({}) == "");
  CHECK(quoted_list({"a"}) == "'a'");
  CHECK(quoted_list({"a", "b"}) == "'a', 'b'");
  const std::string long_list = quoted_list(std::vector<std::string>(13, "x"));
  CHECK(support::contains(long_list, "'x', ..."));
  CHECK(std::ranges::count(long_list, 'x') == 12);
}

TEST_CASE("known_names offers the nearest name if it is near, and lists them all", "[error]") {
  CHECK(known_names("gian", {"floor", "gain"}) == "; did you mean 'gain'? Known: 'floor', 'gain'");
  CHECK(known_names("temperature", {"floor", "gain"}) == "; Known: 'floor', 'gain'");
  CHECK(known_names("x", {}) == "; there are none");
  CHECK(support::contains(known_names("", {"g"}), "Known: 'g'"));
}

TEST_CASE("the distance between words is the number of letters to change", "[error]") {
  CHECK(detail::edit_distance("gain", "gain") == 0);
  CHECK(detail::edit_distance("gain", "gian") == 2);
  CHECK(detail::edit_distance("", "gain") == 4);
  CHECK(detail::edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("a SimulationError carries time, block and results, and is an Error", "[error]") {
  SimulationError error("t = 2 s: stop", 2.0, "plant.tank");
  CHECK(error.time() == 2.0);
  CHECK(error.block() == "plant.tank");
  CHECK(!error.results());
  const auto results = std::make_shared<const Results>();
  error.attach(results);
  CHECK(error.results() == results);
  CHECK_THROWS_AS(throw error, Error);
  CHECK_THROWS_AS(throw ModelError("m"), Error);
  CHECK_THROWS_AS(throw error, std::runtime_error);
}
