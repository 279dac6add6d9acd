// The ball from blocks, over a floor that drops from under it.
#include <saltus/models/bouncing_ball_diagram.hpp>

#include "runner.hpp"

using saltus::models::BouncingBallDiagramParameters;

int main(int argc, char** argv) {
  const auto add = [](CLI::App& app, BouncingBallDiagramParameters& with) {
    app.add_option("--g", with.g, "gravity [m/s^2]")->capture_default_str();
    app.add_option("--e", with.e, "coefficient of restitution, 0 to 1")->capture_default_str();
    app.add_option("--y0", with.y0, "height at the start [m]")->capture_default_str();
    app.add_option("--floor", with.floor, "height of the floor [m]")->capture_default_str();
    app.add_option("--dropped", with.dropped, "height of the floor after its drop [m]")
        ->capture_default_str();
    app.add_option("--drop-time", with.drop_time, "time of the drop [s]")->capture_default_str();
  };
  return examples::run(
      argc, argv, "bouncing_ball_diagram",
      "A bouncing ball from blocks over a floor that drops, against the closed form.", add,
      &saltus::models::bouncing_ball_diagram);
}
