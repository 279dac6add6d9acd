// OutsideWires: what waits in an island, and what it sends.
#include "saltus/simulation/detail/outside_wires.hpp"

#include "support/cases.hpp"

namespace outside_wires_test {

using namespace saltus;

namespace {

OutsideDelivery delivery(double due, int number) { return {due, {0, 0, 0, number, 1.0}}; }

std::vector<int> taken(OutsideWires& wires, double t) {
  std::vector<EventWires::Target> arriving;
  wires.take(t, arriving);
  std::vector<int> numbers;
  for (const EventWires::Target& target : arriving) numbers.push_back(target.number);
  return numbers;
}

}  // namespace

TEST_CASE("deliveries are taken by time, then by wire, in whatever order they came",
          "[event_wires]") {
  OutsideWires wires;
  CHECK(wires.next() == std::numeric_limits<double>::infinity());
  for (const auto& [due, number] : {std::pair(2.0, 1), {1.0, 5}, {2.0, 0}, {1.0, 3}, {3.0, 2}})
    wires.put(delivery(due, number));
  CHECK(wires.next() == 1.0);
  CHECK(taken(wires, 0.5).empty());
  CHECK(taken(wires, 2.0) == std::vector<int>{3, 5, 0, 1});
  CHECK(wires.next() == 3.0);
}

TEST_CASE("an instant that is undone gives back what it took, and sends nothing", "[event_wires]") {
  OutsideWires wires;
  wires.put(delivery(1.0, 0)), wires.put(delivery(1.0, 1)), wires.put(delivery(2.0, 2));
  wires.open();
  wires.fire(7, 0.5);
  wires.open();
  CHECK(taken(wires, 1.0).size() == 2);
  wires.fire(8, 1.0);
  wires.undo();
  CHECK(wires.next() == 1.0);
  REQUIRE(wires.fired().size() == 1);
  CHECK(wires.fired()[0].source == 7);
  CHECK(taken(wires, 5.0) == std::vector<int>{0, 1, 2});
  wires.forget_fired();
  CHECK(wires.fired().empty());
}

}  // namespace outside_wires_test
