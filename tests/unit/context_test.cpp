// Context: a value. with_* returns a new one; context[id] cuts a part out, with_subcontext puts it
// back.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// inner { ball } beside a ball and a block with modes.
struct Nested {
  const Ball* inner_ball;
  const Ball* outer_ball;
  const Leaf* machine;
  const Diagram* inner;
  std::unique_ptr<Diagram> root;

  Nested() {
    DiagramBuilder inside;
    inner_ball = &inside.add<Ball>(BallOptions{}, "ball");
    auto box = std::make_shared<Diagram>(inside.build("inner"));
    inner = box.get();
    DiagramBuilder outside;
    outside.add(box);
    outer_ball = &outside.add<Ball>(BallOptions{.g = 1.62}, "ball");
    machine = &outside.add<Leaf>("machine", [](Leaf& l) {
      l.declare_discrete_state(vec({1.0, 2.0}));
      l.declare_default_mode(3);
      l.declare_dynamic_parameter("weights", vec({1.0, 2.0, 3.0}));
    });
    root = std::make_unique<Diagram>(outside.build());
  }
};

}  // namespace

TEST_CASE("with_ returns a new context and leaves the old one and the system as they were",
          "[context]") {
  const Ball ball;
  const Context a = ball.create_context();
  const Context b = a.with_time(2.0)
                        .with_continuous_state(vec({1.0, -1.0}))
                        .with_parameter("g", 1.62)
                        .with_mode(2);
  CHECK(a.time() == 0.0);
  CHECK(a.continuous_state() == vec({0.0, 0.0}));
  CHECK(a.parameter("g") == vec({9.81}));
  CHECK(a.mode() == 0);
  CHECK(b.time() == 2.0);
  CHECK(b.continuous_state() == vec({1.0, -1.0}));
  CHECK(b.parameter("g") == vec({1.62}));
  CHECK(b.mode() == 2);
  CHECK(ball.create_context().parameter("g") == vec({9.81}));
}

TEST_CASE("a context of a nested diagram gives each system its part, and takes it back",
          "[context]") {
  const Nested nested;
  const Context all = nested.root->create_context(1.0);
  CHECK(all.continuous_state().size() == 4);
  const Context inner = all[nested.inner->system_id()];
  CHECK(inner.time() == 1.0);
  CHECK(inner.continuous_state().size() == 2);
  const Context ball = inner[nested.inner_ball->system_id()].with_continuous_state(vec({5.0, 6.0}));
  CHECK(ball.parameter("g") == vec({9.81}));
  const Context changed = all.with_subcontext(
      nested.inner->system_id(), inner.with_subcontext(nested.inner_ball->system_id(), ball));
  CHECK(changed.continuous_state() == vec({5.0, 6.0, 0.0, 0.0}));
  CHECK(all.continuous_state() == Eigen::VectorXd::Zero(4));
  const Context direct = all.with_subcontext(nested.inner_ball->system_id(), ball);
  CHECK(direct.continuous_state() == changed.continuous_state());
  const Context machine = all[nested.machine->system_id()];
  CHECK(machine.mode() == 3);
  CHECK(machine.discrete_state() == vec({1.0, 2.0}));
  const Context moved = all.with_subcontext(nested.machine->system_id(), machine.with_mode(7));
  CHECK(moved[nested.machine->system_id()].mode() == 7);
  CHECK(all[nested.machine->system_id()].mode() == 3);
}

TEST_CASE("parameters of a diagram are known by path, those of a part by its own", "[context]") {
  const Nested nested;
  const Context all = nested.root->create_context();
  CHECK(all.parameter("ball.g") == vec({1.62}));
  CHECK(all.parameter("inner.ball.g") == vec({9.81}));
  CHECK(all.with_parameter("machine.weights", 4.0).parameter("machine.weights") ==
        vec({4.0, 4.0, 4.0}));
  CHECK(all.with_parameter("machine.weights", vec({7.0, 8.0, 9.0})).parameter("machine.weights") ==
        vec({7.0, 8.0, 9.0}));
  const std::string what = message<ModelError>([&] { all.with_parameter("inner.bal.g", 1.0); });
  CHECK(contains(what, "unknown parameter 'inner.bal.g'; did you mean 'inner.ball.g'?"));
}

TEST_CASE("a wrong size, a value that is not finite, an unknown system are refused", "[context]") {
  const Nested nested;
  const Context all = nested.root->create_context();
  CHECK(message<ModelError>([&] { all.with_continuous_state(vec({1.0})); }) ==
        "continuous state: expected 4 values, found 1");
  CHECK(message<ModelError>([&] {
          all.with_continuous_state(vec({1.0, not_a_number, 0.0, 0.0}));
        }) == "continuous state: entry 1 is nan; give a finite value");
  CHECK(contains(message<ModelError>([&] { all.with_parameter("ball.g", infinite); }),
                 "entry 0 is inf"));
  CHECK(message<ModelError>([&] { all.with_parameter("machine.weights", vec({1.0, 2.0})); }) ==
        "parameter 'machine.weights': expected 3 values, found 2");
  CHECK(message<ModelError>([&] { all.with_time(not_a_number); }) == "time: nan is not finite");
  CHECK(contains(message<ModelError>([&] { all.with_mode(1); }), "take context[id] first"));
  CHECK(contains(message<ModelError>([&] { all.mode(); }), "take context[id] first"));
  const Ball other;
  CHECK(contains(message<ModelError>([&] { all[other.system_id()]; }), "no system with id"));
  CHECK(contains(message<ModelError>([&] { all.with_subcontext(nested.inner->system_id(), all); }),
                 "the context given is not one of 'inner': expected 2 continuous and 0 discrete "
                 "states, 2 parameters and "));
}

TEST_CASE("a state may be written as a list", "[context]") {
  const Ball ball;
  const Context context = ball.create_context().with_continuous_state({10.0, -1.0});
  CHECK(context.continuous_state() == Eigen::Vector2d(10.0, -1.0));
}
