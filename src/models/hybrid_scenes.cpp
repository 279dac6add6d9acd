#include "saltus/models/ball_drag.hpp"
#include "saltus/models/ball_table.hpp"
#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/bouncing_ball_diagram.hpp"
#include "saltus/models/buck_converter.hpp"
#include "saltus/models/integrate_and_fire.hpp"
#include "saltus/models/newtons_cradle.hpp"
#include "saltus/models/rimless_wheel.hpp"
#include "saltus/models/rocking_block.hpp"
#include "saltus/models/stick_slip.hpp"
#include "saltus/models/stiff_contact.hpp"
#include "saltus/models/thermostat.hpp"
#include "saltus/models/two_walls.hpp"
#include "saltus/models/water_tanks.hpp"
#include "shelf.hpp"

namespace saltus::models::detail {

std::vector<ShelfEntry> hybrid_scenes() {
  return {
      {"bouncing-ball", "a ball over a floor, as one leaf", [] { return bouncing_ball(); }},
      {"bouncing-ball-blocks", "the same of blocks; rests on a floor that drops",
       [] { return bouncing_ball_diagram(); }},
      {"ball-drag", "a ball with quadratic drag: Zeno, and no flight is a polynomial",
       [] { return ball_drag(); }},
      {"ball-table", "a ball on a sinusoidal table: a guard that moves, errors that grow",
       [] { return ball_table(); }},
      {"two-walls", "a ball between two walls: nothing to integrate, a hundred roots",
       [] { return two_walls(); }},
      {"newtons-cradle", "five balls a hair apart: chains of impacts after long swings",
       [] { return newtons_cradle(); }},
      {"water-tanks", "two tanks, one tap: Zeno by modes", [] { return water_tanks(); }},
      {"thermostat", "159 switches whose errors add up", [] { return thermostat(); }},
      {"integrate-and-fire", "a driven neuron: spikes that lock to the drive",
       [] { return integrate_and_fire(); }},
      {"stick-slip", "a mass on a belt: a guard at zero when its mode begins",
       [] { return stick_slip(); }},
      {"rimless-wheel", "spokes that roll down a slope: unstable between impacts",
       [] { return rimless_wheel(); }},
      {"buck-converter", "pulse-width modulation: a clock and a moving guard in one loop",
       [] { return buck_converter(); }},
      {"rocking-block", "a block on its edges: Zeno without a reset that turns back",
       [] { return rocking_block(); }},
      {"stiff-contact", "a spring of 1e9 N/m: 1e-4 s of contact between flights, then stiff rest",
       [] { return stiff_contact(); }},
  };
}

}  // namespace saltus::models::detail
