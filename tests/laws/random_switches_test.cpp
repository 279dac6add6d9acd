// Diagrams drawn at random, the same ones each time: integrators whose inputs are chosen by
// comparisons of their outputs. Between switches all is linear; a few lines here know every switch.
#include <random>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr std::size_t states = 3;

struct Network {
  std::array<double, states> start;
  struct Input {
    double high, low;  // rates while the comparison is true, and while it is false
    std::size_t left;  // it compares this state ...
    int right;         // ... with that one, or with `level` (-1)
    double level;
  };
  std::array<Input, states> inputs;

  explicit Network(std::mt19937& random) {
    std::uniform_real_distribution<> real(-1.0, 1.0);
    for (double& x : start) x = real(random);
    for (Input& in : inputs) {
      in = {real(random), real(random),
            std::uniform_int_distribution<std::size_t>(0, states - 1)(random),
            std::uniform_int_distribution<>(-1, states - 1)(random), real(random)};
      if (in.right == static_cast<int>(in.left)) in.right = -1;
    }
  }

  Diagram diagram() const {
    DiagramBuilder builder;
    std::vector<Integrator*> x;
    for (std::size_t i = 0; i < states; ++i)
      x.push_back(
          &builder.add<Integrator>(text("x_", i), Integrator::Options{.initial_state = start[i]}));
    for (std::size_t i = 0; i < states; ++i) {
      const Input& in = inputs[i];
      auto& above = builder.add<Comparator>(text("above_", i), ">");
      auto& choice = builder.add<Switch>(text("choice_", i));
      auto& high = builder.add<Constant>(text("high_", i), in.high);
      auto& low = builder.add<Constant>(text("low_", i), in.low);
      builder.connect(x[in.left]->output(), above.input(0));
      if (in.right >= 0) {
        builder.connect(x[static_cast<std::size_t>(in.right)]->output(), above.input(1));
      } else {
        auto& level = builder.add<Constant>(text("level_", i), in.level);
        builder.connect(level.output(), above.input(1));
      }
      builder.connect(above.output(), choice.input("control"));
      builder.connect(high.output(), choice.input("true_value"));
      builder.connect(low.output(), choice.input("false_value"));
      builder.connect(choice.output(), x[i]->input());
    }
    return builder.build();
  }

  double guard(const Input& in, const std::array<double, states>& x) const {
    return x[in.left] - (in.right >= 0 ? x[static_cast<std::size_t>(in.right)] : in.level);
  }
};

struct Course {
  std::vector<double> times;
  std::vector<std::size_t> which;
  std::array<double, states> end;
  bool sound = true;  // no sliding, no two switches within 1e-6 s of each other
};

Course by_hand(const Network& net, double end) {
  Course course;
  course.end = net.start;
  auto& x = course.end;
  std::array<bool, states> above{};
  for (std::size_t i = 0; i < states; ++i) {
    const double g = net.guard(net.inputs[i], x);
    above[i] = g > 0.0;
    course.sound &= std::abs(g) > 1e-3;
  }
  const auto slope = [&](std::size_t i) {
    const auto rate = [&](std::size_t k) {
      return above[k] ? net.inputs[k].high : net.inputs[k].low;
    };
    const auto& in = net.inputs[i];
    return rate(in.left) - (in.right >= 0 ? rate(static_cast<std::size_t>(in.right)) : 0.0);
  };
  for (double t = 0.0; course.sound && course.times.size() < 100;) {
    double dt = end - t, second = infinite;
    std::size_t next = states;
    for (std::size_t i = 0; i < states; ++i) {
      const double g = net.guard(net.inputs[i], x), wait = -g / slope(i);
      if (std::abs(g) < 1e-12 || !(wait > 0.0)) continue;
      second = std::min(second, std::abs(wait - dt));
      if (wait < dt) dt = wait, next = i;
    }
    course.sound &= second > 1e-6 && dt > 1e-6;
    t += dt;
    for (std::size_t k = 0; k < states; ++k)
      x[k] += dt * (above[k] ? net.inputs[k].high : net.inputs[k].low);
    if (next == states) return course;
    course.times.push_back(t), course.which.push_back(next);
    const double before = slope(next);
    above[next] = !above[next];
    for (std::size_t i = 0; i < states; ++i)  // equal comparisons would tie
      course.sound &= i == next || std::abs(net.guard(net.inputs[i], x)) > 1e-6;
    course.sound &= before * slope(next) > 1e-3 * before * before;  // else it slides, or nearly
  }
  course.sound = false;
  return course;
}

}  // namespace

TEST_CASE("random networks of switched integrators switch when hand calculation says",
          "[laws][random]") {
  const auto method = GENERATE(from_range(methods));
  std::mt19937 random{20260303};
  const double end = 20.0;
  int scenes = 0, switches = 0;
  double most = 0.0, most_end = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const Network net(random);
    const Course course = by_hand(net, end);
    if (!course.sound || course.times.empty()) continue;
    const Diagram diagram = net.diagram();
    const auto results = simulate(diagram, diagram.create_context(), {0.0, end},
                                  {.ode_solver_method = method, .throw_errors = false});
    ++scenes, switches += static_cast<int>(course.times.size());
    INFO("scene " << n << ", method " << method << ": " << to_string(results.status) << " "
                  << results.message);
    CHECK(results.status == Status::reached_end);
    most = std::max(most, worst(firing_times(results.events), course.times));
    for (std::size_t i = 0; i < states; ++i)
      most_end = std::max(
          most_end,
          std::abs(results.context.continuous_state()[static_cast<Index>(i)] - course.end[i]));
  }
  CHECK(scenes > 150);
  // A location errs by 100 eps (t + h) <= 4000 eps s, and hands that on times a ratio of slopes, a
  // thousand at most by the draw's rule; twenty switches.
  within("random switches", method, most, 20.0 * 1e3 * 4000.0 * eps);
  within("random switches, end", method, most_end, 20.0 * 1e3 * 4000.0 * eps);
}
