// What does a diagram of blocks cost, against the same equations in one leaf? The scenes are the
// ball, the ball with drag, both with six bounces, and Van der Pol's oscillator; method and
// tolerance are the same. `diagram drag blocks dopri5 1000` makes a thousand runs of one side, for
// a profiler or to count instructions.
#include <cstring>
#include <saltus/library/library.hpp>

#include "ball.hpp"
#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using bench::Ball, bench::Runner;
using namespace saltus;

SimulatorOptions with(Method method) {
  return {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = method};
}

Runner ball_leaf(const Ball& ball, Method method) {
  // Its functions are called, as those of blocks are.
  const auto leaf = std::make_shared<bench::BallLeaf>(ball, false);
  return {leaf, leaf->create_context().with_continuous_state(Eigen::Vector2d(ball.y0, 0.0)),
          ball.t_end, with(method)};
}

/// Two integrators in a row, which are reset when y falls below 0; drag is one block, v -> -k v
/// |v|.
Runner ball_blocks(const Ball& ball, Method method) {
  DiagramBuilder builder;
  const Integrator::Options reset{.enable_reset = true, .enable_external_reset = true};
  auto& v = builder.add<Integrator>("v", reset);
  auto& y = builder.add<Integrator>("y", reset);
  auto& below = builder.add<Comparator>("below", "<");
  auto& rebound = builder.add<Gain>("rebound", -ball.e);
  auto& gravity = builder.add<Constant>("gravity", -ball.g);
  auto& floor = builder.add<Constant>("floor", 0.0);
  if (ball.k > 0.0) {
    auto& drag = builder.add<FunctionBlock>(
        "drag", [k = ball.k](double speed) { return -k * speed * std::abs(speed); });
    auto& sum = builder.add<Adder>("sum", "++");
    builder.connect(v.output(), drag.input());
    builder.connect(gravity.output(), sum.input(0));
    builder.connect(drag.output(), sum.input(1));
    builder.connect(sum.output(), v.input());
  } else {
    builder.connect(gravity.output(), v.input());
  }
  builder.connect(v.output(), y.input());
  builder.connect(y.output(), below.input(0));
  builder.connect(floor.output(), below.input(1));
  builder.connect(below.output(), v.input("reset_trigger"));
  builder.connect(below.output(), y.input("reset_trigger"));
  builder.connect(v.output(), rebound.input());
  builder.connect(rebound.output(), v.input("reset_value"));
  builder.connect(floor.output(), y.input("reset_value"));
  const auto diagram = std::make_shared<const Diagram>(builder.build("ball"));
  const Context start = diagram->create_context();
  const System& height = (*diagram)["y"];
  const auto high =
      start[height.system_id()].with_continuous_state(Eigen::VectorXd::Constant(1, ball.y0));
  return {diagram, start.with_subcontext(height.system_id(), high), ball.t_end, with(method)};
}

/// x' = v, v' = (1 - x^2) v - x.
class VanDerPol final : public LeafSystem {
 public:
  VanDerPol() : LeafSystem("van_der_pol") {
    declare_continuous_state(
        {.initial = Eigen::Vector2d(2.0, 0.0), .ode = [](const At& at, VectorRef xdot) {
           xdot << at.x[1], (1.0 - at.x[0] * at.x[0]) * at.x[1] - at.x[0];
         }});
  }
};

Runner van_der_pol_blocks(Method method) {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 2.0});
  auto& v = builder.add<Integrator>("v", Integrator::Options{});
  auto& one = builder.add<Constant>("one", 1.0);
  auto& square = builder.add<Product>("square", "**");
  auto& factor = builder.add<Adder>("factor", "+-");
  auto& damping = builder.add<Product>("damping", "**");
  auto& sum = builder.add<Adder>("sum", "+-");
  builder.connect(v.output(), x.input());
  builder.connect(x.output(), square.input(0));
  builder.connect(x.output(), square.input(1));
  builder.connect(one.output(), factor.input(0));
  builder.connect(square.output(), factor.input(1));
  builder.connect(factor.output(), damping.input(0));
  builder.connect(v.output(), damping.input(1));
  builder.connect(damping.output(), sum.input(0));
  builder.connect(x.output(), sum.input(1));
  builder.connect(sum.output(), v.input());
  const auto diagram = std::make_shared<const Diagram>(builder.build("van_der_pol"));
  return {diagram, diagram->create_context(), 100.0, with(method)};
}

Runner van_der_pol_leaf(Method method) {
  const auto leaf = std::make_shared<VanDerPol>();
  return {leaf, leaf->create_context(), 100.0, with(method)};
}

/// A scene, as one leaf and as a diagram.
struct Sides {
  const char* name;
  Runner (*leaf)(Method);
  Runner (*blocks)(Method);
};

const Ball parabola, drag{.k = 9.81 / 400.0};

const std::vector<Sides> scenes{{"ball", [](Method method) { return ball_leaf(parabola, method); },
                                 [](Method method) { return ball_blocks(parabola, method); }},
                                {"drag", [](Method method) { return ball_leaf(drag, method); },
                                 [](Method method) { return ball_blocks(drag, method); }},
                                {"van der pol", van_der_pol_leaf, van_der_pol_blocks}};

void compare(bench::Sheet& sheet, const Sides& scene, Method method) {
  Runner leaf = scene.leaf(method), blocks = scene.blocks(method);
  const auto times = bench::interleave({[&] { leaf(); }, [&] { blocks(); }}, 51);
  const auto &a = leaf.statistics(), &b = blocks.statistics();
  sheet.add({{"scene", scene.name},
             {"method", to_string(method)},
             {"leaf [us]", times[0].time * 1e6},
             {"blocks [us]", times[1].time * 1e6},
             {"ratio", times[1].ratio},
             {"steps of leaf", a.steps},
             {"steps of blocks", b.steps}});
  sheet.target(text(scene.name, ", ", to_string(method), ": blocks against the leaf"),
               times[1].ratio, 1.6);
  sheet.target(text(scene.name, ", ", to_string(method), ": steps that blocks add"),
               static_cast<double>(b.steps - a.steps), 0.0);
}

/// For a profiler: runs only one side of one scene, repeatedly.
int only(const std::string& name, const char* side, Method method, int runs) {
  const auto scene = std::ranges::find(scenes, name, &Sides::name);
  const bool blocks = std::strcmp(side, "blocks") == 0;
  if (scene == scenes.end() || (!blocks && std::strcmp(side, "leaf") != 0)) return 2;
  Runner run = (blocks ? scene->blocks : scene->leaf)(method);
  for (int i = 0; i < runs; ++i) run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5) return only(argv[1], argv[2], method_from(argv[3]), std::atoi(argv[4]));
  bench::Sheet sheet("diagram", "What does a diagram of blocks cost, against one leaf?");
  for (const Method method : {Method::dopri5, Method::dop853})
    for (const Sides& scene : scenes) compare(sheet, scene, method);
}
