// What is computed, and how often: unread blocks never, constants once a run, held values once an
// instant.
#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Passes its input on and counts how often it was asked to.
struct Counted {
  std::shared_ptr<Leaf> block;
  std::shared_ptr<int> calls = std::make_shared<int>(0);

  explicit Counted(std::string name, int inputs = 1) {
    block = std::make_shared<Leaf>(std::move(name), [=, calls = calls](Leaf& l) {
      for (int i = 0; i < inputs; ++i) l.declare_input_port({.shape = Shape::scalar()});
      l.declare_output_port({.name = "out",
                             .calc = [calls](const At& at) { return ++*calls, at.u(0); },
                             .reads = Reads::inputs});
    });
  }
};

}  // namespace

TEST_CASE("a block that nobody reads is never computed, nor what only it reads", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Counted unread("unread"), behind("behind"), read("read");
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.add(unread.block), builder.add(behind.block), builder.add(read.block);
  builder.connect(sine.output(), behind.block->input()),
      builder.connect(behind.block->output(), unread.block->input());
  builder.connect(sine.output(), read.block->input()),
      builder.connect(read.block->output(), integrator.input());
  const Diagram diagram = builder.build();
  simulate(diagram, diagram.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(*unread.calls == 0);
  CHECK(*behind.calls == 0);
  CHECK(*read.calls > 0);
  CHECK(contains(compile(diagram)->describe(),
                 "dropped, nothing reads them: 2 (unread.out, behind.out)"));
}

TEST_CASE("what is recorded is computed once a row, and not in the right-hand side", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Counted shown("shown");
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.add(shown.block);
  builder.connect(sine.output(), integrator.input()),
      builder.connect(integrator.output(), shown.block->input());
  const Diagram diagram = builder.build();
  const auto silent =
      simulate(diagram, diagram.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(*shown.calls == 0);
  CHECK(silent.time.empty());
  const auto results = simulate(
      diagram, diagram.create_context(), {0.0, 20.0},
      {.ode_solver_method = method, .recorded_signals = {{"shown", shown.block->output()}}});
  CHECK(*shown.calls == static_cast<int>(results.time.size()));
  CHECK(results.statistics.right_hand_side_calls == silent.statistics.right_hand_side_calls);
  CHECK(contains(compile(diagram)->describe(), "nothing recorded: no recorder"));
}

TEST_CASE("a constant is computed once a run, however many steps it has", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Counted scaled("scaled");
  DiagramBuilder builder;
  auto& constant = builder.add<Constant>("constant", 2.0);
  auto& product = builder.add<Product>("product");
  auto& sine = builder.add<Sine>("sine");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.add(scaled.block);
  builder.connect(constant.output(), scaled.block->input());
  builder.connect(scaled.block->output(), product.input(0)),
      builder.connect(sine.output(), product.input(1));
  builder.connect(product.output(), integrator.input());
  const Diagram diagram = builder.build();
  simulate(diagram, diagram.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(*scaled.calls == 1);
  CHECK(contains(compile(diagram)->describe(), "constant, computed once: 1 (scaled.out)"));
}

TEST_CASE("a held value is computed at instants, not in between", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Counted held("held");
  DiagramBuilder builder;
  auto& step = builder.add<Step>("step", Step::Options{.step_time = 5.0});
  auto& integrator = builder.add<Integrator>("integrator");
  builder.add(held.block);
  builder.connect(step.output(), held.block->input()),
      builder.connect(held.block->output(), integrator.input());
  const Diagram diagram = builder.build();
  const auto count_to = [&](double t) {
    *held.calls = 0;
    simulate(diagram, diagram.create_context(), {0.0, t},
             {.ode_solver_method = method, .max_minor_step_size = 0.01});
    return *held.calls;
  };
  CHECK(count_to(4.0) == count_to(1.0));
  CHECK(count_to(20.0) == count_to(6.0));
  CHECK(count_to(20.0) <= 12);  // start, step, end: a few passes each
}

TEST_CASE("without continuous state there is no solver: time goes from event to event",
          "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf counter("counter", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(count_up, 0.5);
  });
  const auto results =
      simulate(counter, counter.create_context(), {0.0, 10.0}, {.ode_solver_method = method});
  CHECK(results.context.discrete_state()[0] == 21.0);
  CHECK(results.statistics.steps == 0);
  CHECK(results.statistics.right_hand_side_calls == 0);
  CHECK(results.statistics.method == "none: no continuous state");
  CHECK(contains(compile(counter)->describe(), "no continuous state: no solver"));
}
