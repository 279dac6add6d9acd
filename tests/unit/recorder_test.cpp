// Recorder: rows of what was asked for, at all times or at those asked for.
#include "saltus/simulation/detail/recorder.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two states shown whole and as their quotient, each recorded.
struct Recording {
  Leaf leaf{"leaf", [](Leaf& l) {
              l.declare_continuous_state(2, [](const At&, VectorRef xdot) { xdot.setZero(); });
              l.declare_continuous_state_output("x");
              l.declare_output_port(
                  {.name = "ratio", .calc = [](const At& at) { return at.x[0] / at.x[1]; }});
            }};
  Machine machine{compile(leaf, {{"state", leaf.output(0)}, {"part", leaf.output(1)}})};
  Results results;
  std::vector<double> only;

  Recording() { machine.load(leaf.create_context()); }
  Recorder recorder() { return {machine, results, only.empty() ? nullptr : &only}; }
  void record(Recorder& recorder, double t, int jump, double x0, double x1) {
    const double x[] = {x0, x1};
    recorder.record(t, jump, x);
  }
};

}  // namespace

TEST_CASE("a row has its time, its jump and every signal of that state", "[recorder]") {
  Recording run;
  Recorder recorder = run.recorder();
  run.record(recorder, 0.5, 0, 1.0, 2.0);
  run.record(recorder, 0.5, 1, 3.0, 4.0);
  CHECK(run.results.time == std::vector{0.5, 0.5});
  CHECK(run.results.jump == std::vector{0, 1});
  CHECK(column(run.results, "state", 0) == std::vector{1.0, 3.0});
  CHECK(column(run.results, "state", 1) == std::vector{2.0, 4.0});
  CHECK(column(run.results, "part") == std::vector{0.5, 0.75});
}

TEST_CASE("a row is there if the last one has its time and its jump", "[recorder]") {
  Recording run;
  Recorder recorder = run.recorder();
  CHECK(!recorder.has_row(0.0, 0));
  run.record(recorder, 0.5, 1, 1.0, 2.0);
  CHECK(recorder.has_row(0.5, 1));
  CHECK(!recorder.has_row(0.5, 0));
  CHECK(!recorder.has_row(0.6, 1));
}

TEST_CASE("with times asked for there is one row at each, the last of several", "[recorder]") {
  Recording run;
  run.only = {0.0, 1.0, 2.0};
  Recorder recorder = run.recorder();
  double value = 0.0;
  for (const auto& [t, jump] :
       {std::pair{0.0, 0}, {0.5, 0}, {1.0, 0}, {1.0, 1}, {1.5, 1}, {2.5, 1}})
    run.record(recorder, t, jump, value += 1.0, 1.0);
  CHECK(run.results.time == std::vector{0.0, 1.0});
  CHECK(run.results.jump == std::vector{0, 1});
  CHECK(column(run.results, "state", 0) == std::vector{1.0, 4.0});
  CHECK(column(run.results, "part") == std::vector{1.0, 4.0});
}

TEST_CASE("a value that is not finite is named, and leaves no row", "[recorder]") {
  Recording run;
  Recorder recorder = run.recorder();
  const std::string what =
      message<SimulationError>([&] { run.record(recorder, 0.5, 0, 1.0, 0.0); });
  CHECK(what ==
        "t = 0.5 s: output 'leaf.ratio', recorded as 'part', is not finite (NaN or Inf); "
        "check it at this time");
  CHECK(run.results.time.empty());
  CHECK(run.results.output("state").rows() == 0);
}

TEST_CASE("a new recorder begins with empty columns, a scalar beside a vector", "[recorder]") {
  Recording run;
  run.results.signals.resize(5);
  const Recorder recorder = run.recorder();
  CHECK(!recorder.has_row(0.0, 0));
  REQUIRE(run.results.signals.size() == 2);
  CHECK(run.results.signals[0].name == "state");
  CHECK(run.results.signals[0].shape == Shape::of(2));
  CHECK(run.results.signals[1].shape == Shape::scalar());
}
