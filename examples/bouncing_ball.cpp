// A ball on a floor, as one leaf. The closed form is known, so the program shows the error of every
// method.
#include <saltus/models/bouncing_ball.hpp>

#include "runner/runner.hpp"

int main(int argc, char** argv) {
  saltus::models::BouncingBallParameters with;
  const std::vector<examples::Option> options{
      {"--g", with.g, "gravity [m/s^2]"},
      {"--e", with.e, "coefficient of restitution, 0 to 1"},
      {"--y0", with.y0, "height at the start [m]"},
      {"--v0", with.v0, "velocity at the start, upward [m/s]"},
  };
  return examples::run(argc, argv,
                       {"bouncing_ball", "A bouncing ball as one leaf, against the closed form."},
                       options, with.t_end, [&] { return saltus::models::bouncing_ball(with); });
}
