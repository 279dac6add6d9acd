// BusCreator and BusSelector: the law that a selector undoes a creator, and refusals.
#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;

namespace {

const BusLayout layout{
    {"speed"}, {"imu.rates", Shape::of(3)}, {"imu.heat"}, {"place", Shape::of(2)}};

Numbers selected(const std::vector<std::string>& names, int output = 0) {
  DiagramBuilder builder;
  auto& creator = builder.add<BusCreator>("creator", layout);
  const Value values[] = {1.0, {2.0, 3.0, 4.0, 5.0}, {6.0, 7.0}};
  for (int k = 0; k < 3; ++k)
    builder.connect(builder.add<Constant>(text("u", k), values[k]).output(), creator.input(k));
  auto& selector = builder.add<BusSelector>("selector", layout, names);
  builder.connect(creator.output(), selector.input());
  const Diagram diagram = builder.build();
  SimulatorOptions options;
  options.recorded_signals = {{"y", selector.output(output)}};
  const Results results = simulate(diagram, diagram.create_context(), {0.0, 1.0}, options);
  const auto y = results.output("y");
  Numbers found;
  for (Index i = 0; i < y.cols(); ++i) found.push_back(y(0, i));
  return found;
}

}  // namespace

TEST_CASE("a BusSelector takes the signals of a BusCreator by name", "[library][bus]") {
  CHECK(selected({"speed"}) == Numbers{1.0});
  CHECK(selected({"place", "imu.rates"}) == Numbers{6.0, 7.0});
  CHECK(selected({"place", "imu.rates"}, 1) == Numbers{2.0, 3.0, 4.0});
  CHECK(selected({"imu"}) == Numbers{2.0, 3.0, 4.0, 5.0});
  CHECK(selected({"imu.heat"}) == Numbers{5.0});
}

TEST_CASE("the ports of a bus have the names of its signals", "[library][bus]") {
  CHECK(BusCreator("c", layout).input_names() == std::vector<std::string>{"speed", "imu", "place"});
  CHECK(BusSelector("s", layout, {"imu.rates", "speed"}).output_names() ==
        std::vector<std::string>{"imu_rates", "speed"});
}

/// The trap: a loop through a bus is none where a state is in it. dx/dt = a = 1 beside b = x.
TEST_CASE("a state may be fed through a bus that carries it", "[library][bus]") {
  DiagramBuilder builder;
  const BusLayout two{{"a"}, {"b"}};
  auto& creator = builder.add<BusCreator>("creator", two);
  auto& selector = builder.add<BusSelector>("selector", two, std::vector<std::string>{"a"});
  auto& sum = builder.add<Integrator>("sum", Integrator::Options{.initial_state = 2.0});
  builder.connect(builder.add<Constant>("one", 1.0).output(), creator.input(0));
  builder.connect(sum.output(), creator.input(1));
  builder.connect(creator.output(), selector.input());
  builder.connect(selector.output(), sum.input());
  const Diagram diagram = builder.build();
  CHECK_THAT(at_times(diagram, sum.output(), {3.0})[0], Catch::Matchers::WithinAbs(5.0, rounding));
}

TEST_CASE("a bus refuses names that are not its own, or not unique", "[library][errors]") {
  CHECK(contains(model_error([] { BusSelector("s", layout, {"imu.rate"}); }),
                 "no signal 'imu.rate'"));
  CHECK(contains(model_error([] { BusSelector("s", layout, {"imu.rate"}); }), "'imu.rates'"));
  CHECK(contains(model_error([] { BusSelector("s", layout, {}); }), "no signal is chosen"));
  CHECK(contains(model_error([] { BusCreator("c", {}); }), "without signals"));
  CHECK(contains(model_error([] { BusCreator("c", {{"a"}, {"a"}}); }), "'a' is in the bus twice"));
  CHECK(contains(model_error([] { BusCreator("c", {{"i.a"}, {"b"}, {"i.c"}}); }), "side by side"));
  CHECK(contains(model_error([] { BusCreator("c", {{""}}); }), "expected words"));
}
