#include "saltus/models/ball_drag.hpp"
#include "saltus/models/ball_table.hpp"
#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/bouncing_ball_diagram.hpp"
#include "saltus/models/buck_converter.hpp"
#include "saltus/models/buck_parasitics.hpp"
#include "saltus/models/integrate_and_fire.hpp"
#include "saltus/models/newtons_cradle.hpp"
#include "saltus/models/relay_circuit.hpp"
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
      entry<BouncingBallParameters>("bouncing-ball", "a ball over a floor, as one leaf",
                                    &bouncing_ball,
                                    {{"g", &BouncingBallParameters::g, positive},
                                     {"e", &BouncingBallParameters::e, 0, 1},
                                     {"y0", &BouncingBallParameters::y0, 0},
                                     {"v0", &BouncingBallParameters::v0},
                                     {"t_end", &BouncingBallParameters::t_end, positive}}),
      entry<BouncingBallDiagramParameters>(
          "bouncing-ball-blocks", "the same of blocks; rests on a floor that drops",
          &bouncing_ball_diagram,
          {{"g", &BouncingBallDiagramParameters::g, positive},
           {"e", &BouncingBallDiagramParameters::e, 0, below_one},
           {"y0", &BouncingBallDiagramParameters::y0, 0},
           {"floor", &BouncingBallDiagramParameters::floor},
           {"dropped", &BouncingBallDiagramParameters::dropped},
           {"drop_time", &BouncingBallDiagramParameters::drop_time, positive},
           {"t_end", &BouncingBallDiagramParameters::t_end, positive}},
          BouncingBallDiagramParameters{}, true,
          {"floor <= y0, dropped <= floor",
           [](const BouncingBallDiagramParameters& p) {
             return p.floor <= p.y0 && p.dropped <= p.floor;
           }}),
      entry<BallDragParameters>(
          "ball-drag", "a ball with quadratic drag: Zeno, and no flight is a polynomial",
          &ball_drag,
          {{"g", &BallDragParameters::g, positive},
           {"c", &BallDragParameters::c, positive},
           {"e", &BallDragParameters::e, positive, below_one},
           {"y0", &BallDragParameters::y0, positive},
           {"v0", &BallDragParameters::v0},
           {"t_end", &BallDragParameters::t_end, positive}},
          BallDragParameters{}, true,
          {"v0 above minus the terminal speed sqrt(g / c)",
           [](const BallDragParameters& p) { return p.v0 > -std::sqrt(p.g / p.c); }}),
      entry<BallTableParameters>(
          "ball-table", "a ball on a sinusoidal table: a guard that moves, errors that grow",
          &ball_table,
          {{"g", &BallTableParameters::g, positive},
           {"e", &BallTableParameters::e, positive, 1},
           {"amplitude", &BallTableParameters::amplitude, 0},
           {"w", &BallTableParameters::w, positive},
           {"y0", &BallTableParameters::y0, positive},
           {"v0", &BallTableParameters::v0},
           {"t_end", &BallTableParameters::t_end, positive}}),
      entry<TwoWallsParameters>(
          "two-walls", "a ball between two walls: nothing to integrate, a hundred roots",
          &two_walls,
          {{"length", &TwoWallsParameters::length, positive},
           {"e", &TwoWallsParameters::e, positive, 1},
           {"x0", &TwoWallsParameters::x0, positive},
           {"v0", &TwoWallsParameters::v0},
           {"t_end", &TwoWallsParameters::t_end, positive}},
          TwoWallsParameters{}, true,
          {"0 < x0 < length, v0 not 0",
           [](const TwoWallsParameters& p) { return p.x0 < p.length && p.v0 != 0.0; }}),
      entry<NewtonsCradleParameters>(
          "newtons-cradle", "five balls with small gaps: chains of impacts after long swings",
          &newtons_cradle,
          {{"balls", &NewtonsCradleParameters::balls, 2, 1000},
           {"gap", &NewtonsCradleParameters::gap, positive},
           {"w", &NewtonsCradleParameters::w, positive},
           {"amplitude", &NewtonsCradleParameters::amplitude, positive},
           {"t_end", &NewtonsCradleParameters::t_end, positive}},
          NewtonsCradleParameters{}, true,
          {"amplitude > balls gap",
           [](const NewtonsCradleParameters& p) { return p.amplitude > p.balls * p.gap; }}),
      entry<WaterTanksParameters>("water-tanks", "two tanks, one tap: Zeno by modes", &water_tanks,
                                  {{"w", &WaterTanksParameters::w, positive},
                                   {"v1", &WaterTanksParameters::v1, positive},
                                   {"v2", &WaterTanksParameters::v2, positive},
                                   {"r1", &WaterTanksParameters::r1},
                                   {"r2", &WaterTanksParameters::r2},
                                   {"x1", &WaterTanksParameters::x1},
                                   {"x2", &WaterTanksParameters::x2},
                                   {"t_end", &WaterTanksParameters::t_end, positive}},
                                  WaterTanksParameters{}, true,
                                  {"v1 and v2 below w, v1 + v2 above it, x1 > r1, x2 > r2",
                                   [](const WaterTanksParameters& p) {
                                     return p.v1 < p.w && p.v2 < p.w && p.v1 + p.v2 > p.w &&
                                            p.x1 > p.r1 && p.x2 > p.r2;
                                   }}),
      entry<ThermostatParameters>("thermostat", "159 switches whose errors add up", &thermostat,
                                  {{"low", &ThermostatParameters::low},
                                   {"high", &ThermostatParameters::high},
                                   {"outside", &ThermostatParameters::outside},
                                   {"heater", &ThermostatParameters::heater},
                                   {"tau", &ThermostatParameters::tau, positive},
                                   {"start", &ThermostatParameters::start},
                                   {"t_end", &ThermostatParameters::t_end, positive}},
                                  ThermostatParameters{}, true,
                                  {"outside < low <= start < high < heater",
                                   [](const ThermostatParameters& p) {
                                     return p.outside < p.low && p.low <= p.start &&
                                            p.start < p.high && p.high < p.heater;
                                   }}),
      entry<IntegrateAndFireParameters>("integrate-and-fire",
                                        "a driven neuron: spikes that lock to the drive",
                                        &integrate_and_fire,
                                        {{"tau", &IntegrateAndFireParameters::tau, positive},
                                         {"a", &IntegrateAndFireParameters::a},
                                         {"b", &IntegrateAndFireParameters::b},
                                         {"w", &IntegrateAndFireParameters::w},
                                         {"threshold", &IntegrateAndFireParameters::threshold},
                                         {"reset", &IntegrateAndFireParameters::reset},
                                         {"t_end", &IntegrateAndFireParameters::t_end, positive}},
                                        IntegrateAndFireParameters{}, true,
                                        {"reset < threshold, and 0 < threshold",
                                         [](const IntegrateAndFireParameters& p) {
                                           return p.reset < p.threshold && p.threshold > 0.0;
                                         }}),
      entry<StickSlipParameters>(
          "stick-slip", "a mass on a belt: a guard at zero when its mode begins", &stick_slip,
          {{"m", &StickSlipParameters::m, positive},
           {"k", &StickSlipParameters::k, positive},
           {"belt", &StickSlipParameters::belt, positive},
           {"fs", &StickSlipParameters::fs, positive},
           {"fk", &StickSlipParameters::fk, positive},
           {"t_end", &StickSlipParameters::t_end, positive}},
          StickSlipParameters{}, true,
          {"fk < fs", [](const StickSlipParameters& p) { return p.fk < p.fs; }}),
      entry<RimlessWheelParameters>("rimless-wheel",
                                    "spokes that roll down a slope: unstable between impacts",
                                    &rimless_wheel,
                                    {{"alpha", &RimlessWheelParameters::alpha, positive, 1.5},
                                     {"slope", &RimlessWheelParameters::slope},
                                     {"rate", &RimlessWheelParameters::rate},
                                     {"t_end", &RimlessWheelParameters::t_end, positive}}),
      entry<BuckConverterParameters>(
          "buck-converter", "pulse-width modulation: a clock and a moving guard in one loop",
          &buck_converter,
          {{"E", &BuckConverterParameters::E},
           {"L", &BuckConverterParameters::L, positive},
           {"C", &BuckConverterParameters::C, positive},
           {"R", &BuckConverterParameters::R, positive},
           {"T", &BuckConverterParameters::T, positive},
           {"a", &BuckConverterParameters::a},
           {"v_ref", &BuckConverterParameters::v_ref},
           {"low", &BuckConverterParameters::low},
           {"high", &BuckConverterParameters::high},
           {"i0", &BuckConverterParameters::i0},
           {"v0", &BuckConverterParameters::v0},
           {"t_end", &BuckConverterParameters::t_end, positive}}),
      entry<RockingBlockParameters>(
          "rocking-block", "a block on its edges: Zeno without a reset that turns back",
          &rocking_block,
          {{"p", &RockingBlockParameters::p, positive},
           {"alpha", &RockingBlockParameters::alpha, positive, 1.5},
           {"r", &RockingBlockParameters::r, positive, below_one},
           {"tilt", &RockingBlockParameters::tilt, positive, 1.5},
           {"t_end", &RockingBlockParameters::t_end, positive}},
          RockingBlockParameters{}, true,
          {"tilt < alpha", [](const RockingBlockParameters& p) { return p.tilt < p.alpha; }}),
      entry<StiffContactParameters>(
          "stiff-contact",
          "a spring of 1e9 N/m: 1e-4 s of contact between flights, then stiff rest", &stiff_contact,
          {{"g", &StiffContactParameters::g, positive},
           {"m", &StiffContactParameters::m, positive},
           {"k", &StiffContactParameters::k, positive},
           {"damping", &StiffContactParameters::damping, 0, below_one},
           {"y0", &StiffContactParameters::y0, positive},
           {"t_end", &StiffContactParameters::t_end, positive}}),
      entry<BuckParasiticsParameters>(
          "buck-parasitics", "a buck converter whose switches are resistors: rates of 1e9 /s",
          &buck_parasitics,
          {{"E", &BuckParasiticsParameters::E, positive},
           {"L", &BuckParasiticsParameters::L, positive},
           {"C", &BuckParasiticsParameters::C, positive},
           {"R", &BuckParasiticsParameters::R, positive},
           {"on", &BuckParasiticsParameters::on, positive},
           {"off", &BuckParasiticsParameters::off, positive},
           {"Cx", &BuckParasiticsParameters::Cx, positive},
           {"Lc", &BuckParasiticsParameters::Lc, positive},
           {"r", &BuckParasiticsParameters::r, 0},
           {"T", &BuckParasiticsParameters::T, positive},
           {"duty", &BuckParasiticsParameters::duty, positive, below_one},
           {"i0", &BuckParasiticsParameters::i0, 0},
           {"v0", &BuckParasiticsParameters::v0},
           {"t_end", &BuckParasiticsParameters::t_end, positive}}),
      entry<RelayCircuitParameters>(
          "relay-circuit",
          "a relay that switches a stiff RLC circuit: a ringing layer at each event",
          &relay_circuit,
          {{"E", &RelayCircuitParameters::E, positive},
           {"L", &RelayCircuitParameters::L, positive},
           {"R1", &RelayCircuitParameters::R1, positive},
           {"C1", &RelayCircuitParameters::C1, positive},
           {"R2", &RelayCircuitParameters::R2, positive},
           {"C2", &RelayCircuitParameters::C2, positive},
           {"R3", &RelayCircuitParameters::R3, positive},
           {"low", &RelayCircuitParameters::low, positive},
           {"high", &RelayCircuitParameters::high, positive},
           {"t_end", &RelayCircuitParameters::t_end, positive}},
          RelayCircuitParameters{}, true,
          {"low < high", [](const RelayCircuitParameters& p) { return p.low < p.high; }}),
  };
}

}  // namespace saltus::models::detail
