// What declarations refuse, and the names they give.
#include "saltus/model/context_entry.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

template <class Declare>
std::string refused(Declare declare) {
  return message<ModelError>([&] { Leaf("block", declare); });
}

}  // namespace

TEST_CASE("a state that is declared twice, or not finite, is refused", "[declare]") {
  CHECK(contains(refused([](Leaf& l) { declare_ramp(l), declare_ramp(l); }),
                 "block 'block': the continuous state is declared twice"));
  CHECK(contains(refused([](Leaf& l) {
                   l.declare_discrete_state(vec({1.0})), l.declare_discrete_state(vec({1.0}));
                 }),
                 "the discrete state is declared twice"));
  CHECK(contains(refused([](Leaf& l) { declare_ramp(l, 1.0, not_a_number); }),
                 "initial continuous state: entry 0 is nan"));
  CHECK(contains(refused([](Leaf& l) { l.declare_discrete_state(vec({1.0, infinite})); }),
                 "initial discrete state: entry 1 is inf"));
  CHECK(contains(refused([](Leaf& l) { l.declare_dynamic_parameter("k", not_a_number); }),
                 "parameter 'k': entry 0 is nan"));
}

TEST_CASE("a name that is declared twice is refused, for every kind of declaration", "[declare]") {
  const std::string twice = "block 'block': the name 'n' is declared twice";
  const auto guard = [](const At& at) { return at.time; };
  const auto update = [](const At&, Next&) {};
  CHECK(refused([](Leaf& l) {
          l.declare_dynamic_parameter("n", 1.0), l.declare_dynamic_parameter("n", 2.0);
        }) == twice);
  CHECK(refused([](Leaf& l) {
          l.declare_input_port({.name = "n"}), l.declare_input_port({.name = "n"});
        }) == twice);
  CHECK(refused([&](Leaf& l) {
          l.declare_output_port({.name = "n", .calc = guard}),
              l.declare_output_port({.name = "n", .calc = guard});
        }) == twice);
  CHECK(refused([&](Leaf& l) {
          l.declare_zero_crossing({.name = "n", .guard = guard}),
              l.declare_zero_crossing({.name = "n", .guard = guard});
        }) == twice);
  CHECK(refused([&](Leaf& l) {
          l.declare_relation({.name = "n", .guard = guard}),
              l.declare_relation({.name = "n", .guard = guard});
        }) == twice);
  CHECK(refused([&](Leaf& l) {
          l.declare_periodic_update(update, 1.0, 0.0, "n"), l.declare_one_shot(1.0, update, "n");
        }) == twice);
}

TEST_CASE("what has no function, or no sensible time, is refused", "[declare]") {
  const auto update = [](const At&, Next&) {};
  CHECK(contains(refused([](Leaf& l) { l.declare_output_port({.name = "y"}); }),
                 "output 'y' has no function"));
  CHECK(contains(refused([](Leaf& l) { l.declare_zero_crossing({.name = "z"}); }),
                 "zero crossing 'z' has no guard"));
  CHECK(contains(refused([](Leaf& l) {
                   l.declare_zero_crossing({.name = "z",
                                            .guard = [](const At& at) { return at.time; },
                                            .zeno_tolerance = -1.0});
                 }),
                 "has zeno_tolerance -1; expected a time >= 0 s"));
  for (const double period : {0.0, -2.0, not_a_number}) {
    CHECK(contains(refused([&](Leaf& l) { l.declare_periodic_update(update, period); }),
                   "expected period > 0"));
  }
  CHECK(contains(refused([&](Leaf& l) { l.declare_periodic_update(update, 1.0, infinite); }),
                 "finite offset"));
  CHECK(contains(refused([&](Leaf& l) { l.declare_one_shot(not_a_number); }),
                 "time event 'one_shot_0' at nan s"));
}

TEST_CASE("nameless declarations get names", "[declare]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_input_port(), l.declare_input_port({.name = "force"}), l.declare_input_port();
    l.declare_output_port({.calc = [](const At& at) { return at.time; }});
    declare_ramp(l);
  });
  CHECK(leaf.input_names() == std::vector<std::string>{"in_0", "force", "in_2"});
  CHECK(leaf.output_names() == std::vector<std::string>{"out_0", "x"});
  CHECK(leaf.input("force").index == 1);
  CHECK(message<ModelError>([&] { leaf.input("farce"); }) ==
        "block 'leaf' has no input 'farce'; did you mean 'force'? Known: 'in_0', 'force', 'in_2'");
  CHECK(message<ModelError>([&] { leaf.output(2); }) ==
        "block 'leaf' has no output 2: it has 2 ('out_0', 'x')");
  CHECK(message<ModelError>([&] { leaf.output(-1); }) ==
        "block 'leaf' has no output -1: it has 2 ('out_0', 'x')");
}

TEST_CASE("the name of a state is an output that shows it, and a value of the context",
          "[declare]") {
  const auto ball = [](std::vector<std::string> names) {
    return Leaf("ball", [&](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({2.0, -1.0}), .names = names, .ode = [](const At& at, VectorRef xdot) {
             xdot << at.x[1], 0.0;
           }});
    });
  };
  const Leaf named = ball({"height", "velocity"});
  CHECK(named.output_names() == std::vector<std::string>{"height", "velocity"});
  const auto results = simulate(named, named.create_context(), {0.0, 1.0},
                                {.recorded_signals = {{"h", named.output("height")}}});
  const auto heights = results.output("h");
  CHECK(heights(0, 0) == 2.0);
  CHECK(heights(heights.rows() - 1, 0) == Approx(1.0).margin(1e-9));  // a straight line
  Context context = named.create_context();
  write_entry(context, find_entry(context.layout(), "velocity"), std::vector{3.0}, "velocity");
  CHECK(context.continuous_state() == vec({2.0, 3.0}));
  CHECK(entry_names(context.layout()) == std::vector<std::string>{"height", "velocity", "mode"});

  const auto refused_for = [&](std::vector<std::string> names) {
    return message<ModelError>([&] { ball(names); });
  };
  CHECK(contains(refused_for({"height"}), "expected 2 names, one for each state, found 1"));
  CHECK(contains(refused_for({"y", "y"}), "the name 'y' is given twice"));
  CHECK(contains(refused_for({"x", "v"}), "'x' cannot be the name of a state"));
  CHECK(contains(refused_for({"a.b", "v"}), "'a.b' cannot be the name of a state"));
}
