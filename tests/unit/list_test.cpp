// List and nth: entries by numbers of any integer type.
#include "saltus/base/list.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "support/catch.hpp"

using saltus::List, saltus::nth;

namespace {

enum class Colour : unsigned char { red, green };

}  // namespace

TEST_CASE("a list has the same entries for numbers of every integer type") {
  List<std::string> all = {"a", "b", "c"};
  const List<std::string>& constant = all;
  CHECK(all[1] == "b");
  CHECK(&all[std::size_t{2}] == &all[2]);
  CHECK(&all[std::int64_t{2}] == &all[2]);
  CHECK(&constant[static_cast<signed char>(2)] == &all[2]);
  all[0] = "d";
  CHECK(constant[0] == "d");
}

TEST_CASE("a list has a size of any integer type") {
  constexpr std::int64_t three = 3;
  List<double> all(three, 1.5);
  CHECK(all == List<double>{1.5, 1.5, 1.5});
  CHECK(List<double>(three) == List<double>{0.0, 0.0, 0.0});
  all.resize(2);
  CHECK(all.size() == 2);
  all.resize(three, 2.5);
  CHECK(all == List<double>{1.5, 1.5, 2.5});
  all.assign(1, 4.0);
  CHECK(all == List<double>{4.0});
}

TEST_CASE("numbers in braces are entries, as in a vector") {
  CHECK(List<int>{3, 1}.size() == 2);
  CHECK(List<int>(3, 1).size() == 3);
}

TEST_CASE("a list takes the memory of a vector, and is one where a vector is asked for") {
  std::vector<int> vector = {4, 5};
  const int* memory = vector.data();
  const List<int> list = std::move(vector);
  CHECK(list.data() == memory);
  const std::vector<int>& again = list;
  CHECK(again == std::vector{4, 5});
}

TEST_CASE("the entries of arrays, spans and tables have numbers of every type") {
  std::array<int, 3> all{7, 8, 9};
  nth(all, std::int64_t{1}) = 6;
  CHECK(all[1] == 6);
  CHECK(nth(std::span(all), 2) == 9);
  constexpr std::array names{"red", "green"};
  CHECK(std::string(nth(names, Colour::green)) == "green");
}
