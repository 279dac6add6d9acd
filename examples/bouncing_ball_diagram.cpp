// The ball from blocks, over a floor that drops from under it.
#include <saltus/models/bouncing_ball_diagram.hpp>

#include "runner/runner.hpp"

int main(int argc, char** argv) {
  saltus::models::BouncingBallDiagramParameters with;
  const std::vector<examples::Option> options{
      {"--g", with.g, "gravity [m/s^2]"},
      {"--e", with.e, "coefficient of restitution, 0 to 1"},
      {"--y0", with.y0, "height at the start [m]"},
      {"--floor", with.floor, "height of the floor [m]"},
      {"--dropped", with.dropped, "height of the floor after its drop [m]"},
      {"--drop-time", with.drop_time, "time of the drop [s]"},
  };
  return examples::run(
      argc, argv,
      {"bouncing_ball_diagram",
       "A bouncing ball from blocks over a floor that drops, against the closed form."},
      options, with.t_end, [&] { return saltus::models::bouncing_ball_diagram(with); });
}
