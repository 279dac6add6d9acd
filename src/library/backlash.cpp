// y follows u through a play.
#include "saltus/library/backlash.hpp"

#include <cmath>
#include <limits>

#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

namespace {

/// Where y rests from a turn on: some roundings inside of the play. At the very contact the guard of
/// drive_up or drive_down would be a rounding on either side of zero, and one beyond it drives y.
double rests_at(double u, double side, double width) {
  const double inside = 8.0 * std::numeric_limits<double>::epsilon() * (std::abs(u) + width);
  return u - side * (0.5 * width - inside);
}

/// [of the play] How far u may be back behind its contact: far more than the rounding and the error of
/// a run move it, and little beside the play.
constexpr double returned = 1e-3;

[[noreturn]] void throw_wrong_rate(const std::string& block, const At& at) {
  const char* way = at.z[1] > 0.0 ? "upward" : "downward";
  throw SimulationError(text("t = ", at.time, " s: block '", block, "': u drives y ", way,
                             ", and came back to where the contact began, u = ", at.u(0),
                             ", but in_rate did not change its sign: it is ", at.u(1),
                             " now. Expected: in_rate is the rate of in, du/dt, and in does not "
                             "jump. Connect the speed "
                             "of the same shaft, as from the integrator of the position"),
                        at.time, block);
}

}  // namespace

/// z = (y while it rests; 1 while u drives y upward, -1 downward, 0 while y rests).
Backlash::Backlash(std::string name, double width, const Options& options)
    : LeafSystem(std::move(name)) {
  const ParameterIndex play = declare_dynamic_parameter("width", width);
  declare_parameter_check(detail::positive(play, "width"));
  declare_discrete_state(Eigen::Vector2d(options.initial_output, 0.0));
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_input_port({.name = "in_rate", .shape = Shape::scalar()});
  declare_contact("drive_up", 1.0, play);
  declare_contact("drive_down", -1.0, play);
  declare_turn(play);
  declare_return(play);
  declare_outputs(play);
}

void Backlash::declare_contact(const char* event, double side, ParameterIndex width) {
  declare_zero_crossing(
      {.name = event,
       .reset_map = [side](const At& at, Next& next) { next.set_discrete_state({at.z[0], side}); },
       .direction = Direction::negative_then_non_negative,
       .at_start = AtStart::fire,
       .zeno_tolerance = 0.0,  // the block has no state that could rest
       .inputs = std::vector{0},
       .formula =
           [=](const auto& at, Index) {
             const auto beyond = side * (at.u(0, 0) - at.z(0)) - 0.5 * at.p(width, 0);
             return at.choose(at.z(1) == 0.0, beyond, -1.0);
           }});
}

/// The guard is the rate, so that a turn between two looks shows as a dip. A rate of exactly 0 is
/// no turn: a shaft that stops and goes on in the same direction never leaves the contact.
void Backlash::declare_turn(ParameterIndex width) {
  declare_zero_crossing({.name = "turn",
                         .reset_map =
                             [width](const At& at, Next& next) {
                               next.set_discrete_state(
                                   {rests_at(at.u(0), at.z[1], at.p[width]), 0.0});
                             },
                         .direction = Direction::positive_then_non_positive,
                         .at_start = AtStart::fire,
                         .zeno_tolerance = 0.0,
                         .inputs = std::vector{0, 1},
                         .formula =
                             [](const auto& at, Index) {
                               const auto rate = at.z(1) * at.u(1, 0);
                               return at.choose(rate == 0.0, 1.0, rate);
                             }});
}

/// In contact y never goes back behind the place where the contact began, z(0), unless u has turned
/// and the rate has not shown it.
void Backlash::declare_return(ParameterIndex width) {
  declare_zero_crossing(
      {.name = "return_without_turn",
       .reset_map = [block = name()](const At& at, Next&) { throw_wrong_rate(block, at); },
       .direction = Direction::positive_then_non_positive,
       .zeno_tolerance = 0.0,
       .inputs = std::vector{0, 1},
       .formula =
           [=](const auto& at, Index) {
             const auto beyond = at.z(1) * (at.u(0, 0) - at.z(0)) - 0.5 * at.p(width, 0);
             return at.choose(at.z(1) == 0.0, 1.0, beyond + returned * at.p(width, 0));
           }});
}

void Backlash::declare_outputs(ParameterIndex width) {
  declare_output_port({.name = "out",
                       .reads = Reads::discrete_state | Reads::inputs,
                       .inputs = std::vector{0},
                       .formula = [width](const auto& at, Index) {
                         return at.choose(at.z(1) != 0.0,
                                          at.u(0, 0) - 0.5 * at.z(1) * at.p(width, 0), at.z(0));
                       }});
  declare_output_port({.name = "out_rate",
                       .reads = Reads::discrete_state | Reads::inputs,
                       .inputs = std::vector{1},
                       .formula = [](const auto& at, Index) {
                         return at.choose(at.z(1) != 0.0, at.u(1, 0), 0.0);
                       }});
}

}  // namespace saltus
