// A ball on a floor, as one leaf. The closed form is known, so the program shows the error of every
// method.
#include <saltus/models/bouncing_ball.hpp>

#include "runner.hpp"

using saltus::models::BouncingBallParameters;

int main(int argc, char** argv) {
  const auto add = [](CLI::App& app, BouncingBallParameters& with) {
    app.add_option("--g", with.g, "gravity [m/s^2]")->capture_default_str();
    app.add_option("--e", with.e, "coefficient of restitution, 0 to 1")->capture_default_str();
    app.add_option("--y0", with.y0, "height at the start [m]")->capture_default_str();
    app.add_option("--v0", with.v0, "velocity at the start, upward [m/s]")->capture_default_str();
  };
  return examples::run(argc, argv, "bouncing_ball",
                       "A bouncing ball as one leaf, against the closed form.", add,
                       &saltus::models::bouncing_ball);
}
