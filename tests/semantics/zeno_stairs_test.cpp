// Semantics 2.5, 4.5: balls over floors that step at random times, in every form: none is ever
// below its floor, resting or flying.
#include <random>

#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Stairs {
  std::vector<double> times, heights;
};

std::shared_ptr<const System> floor_of(const Stairs& stairs) {
  return std::make_shared<Leaf>("floor", [=](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("height");
    for (std::size_t i = 0; i < stairs.times.size(); ++i) {
      const double height = stairs.heights[i];
      l.declare_one_shot(stairs.times[i],
                         [=](const At&, Next& next) { next.set_discrete_state({height}); });
    }
  });
}

/// Four steps, each down, or up or down.
Stairs random_stairs(std::mt19937& random, bool up_too) {
  std::uniform_real_distribution<> number(0.0, 1.0);
  Stairs stairs;
  double t = 0.0, height = 0.0;
  for (int i = 0; i < 4; ++i) {
    t += 0.05 + 0.8 * number(random);
    const bool up = up_too && number(random) < 0.5;
    height += up ? 0.3 * number(random) : -0.5 * number(random);
    stairs.times.push_back(t), stairs.heights.push_back(height);
  }
  return stairs;
}

void no_ball_falls(bool up_too, bool forms_agree) {
  std::mt19937 random(11);
  std::uniform_real_distribution<> number(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const Stairs stairs = random_stairs(random, up_too);
    const double e = std::array{0.0, 0.3, 0.6, 0.9}[random() % 4];
    const double start = std::array{0.0, 0.2, 1.0}[random() % 3], end = stairs.times.back() + 0.5;
    const auto method = methods[random() % methods.size()];
    std::vector<double> heights;
    for (const BallScene& scene :
         all_forms_over({.g = 10.0, .e = e}, [&] { return floor_of(stairs); })) {
      const auto results = simulate(
          *scene.system, scene.context(start, 0.0), {0.0, end},
          {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method, .throw_errors = false});
      heights.push_back(results.context.continuous_state()[0]);
      INFO(i << ", " << scene.form << ", method " << method << ", e " << e << ": "
             << to_string(results.status) << " at " << heights.back() << " over a floor at "
             << stairs.heights.back() << ", as a leaf " << heights.front());
      CHECK(results.status == Status::reached_end);
      CHECK(heights.back() > stairs.heights.back() - 1e-7);
      // An error of 1e-9 m at a contact is one of 1e-9 / v s in it; a hundred contacts.
      if (forms_agree) CHECK(std::abs(heights.back() - heights.front()) < 1e-4);
    }
  }
}

}  // namespace

TEST_CASE("4.5 over a floor that steps down no ball is ever below it, and all forms agree",
          "[semantics]") {
  no_ball_falls(false, true);
}

TEST_CASE("4.5 over a floor that steps up and down no ball is ever below it", "[semantics]") {
  no_ball_falls(true, false);
}
