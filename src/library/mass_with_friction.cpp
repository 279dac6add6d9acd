// mass dv/dt = u - viscous v - coulomb sign(v), dx/dt = v; a body at v = 0 sticks.
#include "saltus/library/mass_with_friction.hpp"

#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

/// z = 1 while it slides upward, -1 downward, 0 while it sticks.
MassWithFriction::MassWithFriction(std::string name, const Options& options)
    : LeafSystem(std::move(name)) {
  mass_ = declare_dynamic_parameter("mass", options.mass);
  coulomb_ = declare_dynamic_parameter("coulomb", options.coulomb);
  static_ = declare_dynamic_parameter("static", options.static_friction.value_or(options.coulomb));
  viscous_ = declare_dynamic_parameter("viscous", options.viscous);
  declare_checks();
  declare_discrete_state(Eigen::VectorXd::Zero(1));
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_motion(options);
  declare_slip("slip_up", 1.0);
  declare_slip("slip_down", -1.0);
  declare_stick();
}

void MassWithFriction::declare_checks() {
  declare_parameter_check(detail::positive(mass_, "mass", " kg"));
  declare_parameter_check(detail::not_negative(coulomb_, "coulomb", " N"));
  declare_parameter_check(detail::not_negative(viscous_, "viscous", " N s/m"));
  declare_parameter_check([rest = static_, moving = coulomb_](const std::string& block,
                                                              const ParameterValues& p) {
    detail::insist(p[rest] >= p[moving], block, "static friction ", p[rest], " N is below coulomb ",
                   p[moving], " N; expected static friction >= coulomb");
  });
}

void MassWithFriction::declare_motion(const Options& options) {
  declare_continuous_state(
      {.initial = Eigen::Vector2d(options.initial_position, options.initial_velocity),
       .reads = Reads::continuous_state | Reads::discrete_state | Reads::inputs,
       .formula = [=, mass = mass_, coulomb = coulomb_, viscous = viscous_](const auto& at,
                                                                            Index i) {
         if (i == 0) return at.choose(at.z(0) != 0.0, at.x(1), 0.0);
         const auto force = at.u(0, 0) - at.p(viscous, 0) * at.x(1) - at.z(0) * at.p(coulomb, 0);
         return at.choose(at.z(0) != 0.0, force / at.p(mass, 0), 0.0);
       }});
  declare_output_port(
      {.name = "x", .reads = Reads::continuous_state, .view = Place{Space::x, 0, 1}});
  declare_output_port(
      {.name = "v", .reads = Reads::continuous_state, .view = Place{Space::x, 1, 1}});
}

/// A body that sticks begins to slide where the force exceeds the static friction, and at the start
/// of a run with a velocity. A force that is exactly the static friction holds it.
void MassWithFriction::declare_slip(const char* event, double side) {
  declare_zero_crossing(
      {.name = event,
       .reset_map = [side](const At&, Next& next) { next.set_discrete_state({side}); },
       .direction = Direction::negative_then_non_negative,
       .at_start = AtStart::fire,
       .zeno_tolerance = 0.0,  // sticking is a state of its own
       .formula =
           [=, limit = static_](const auto& at, Index) {
             const auto moves = at.choose(side * at.x(1) > 0.0, 1.0, -1.0);
             const auto excess = side * at.u(0, 0) - at.p(limit, 0);
             const auto pushed = at.choose(excess == 0.0, -1.0, excess);
             const auto at_rest = at.choose(at.x(1) == 0.0, pushed, moves);
             return at.choose(at.z(0) == 0.0, at_rest, -1.0);
           }});
}

void MassWithFriction::declare_stick() {
  declare_zero_crossing(
      {.name = "stick",
       .reset_map =
           [](const At& at, Next& next) {
             next.set_continuous_state({at.x[0], 0.0});
             next.set_discrete_state({0.0});
           },
       .direction = Direction::positive_then_non_positive,
       .zeno_tolerance = 0.0,
       .inputs = std::vector<int>{},
       .formula = [](const auto& at,
                     Index) { return at.choose(at.z(0) != 0.0, at.z(0) * at.x(1), 1.0); }});
}

}  // namespace saltus
