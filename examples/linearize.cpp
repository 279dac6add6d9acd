// A pole on a cart: its standing equilibrium by trim, the matrices there, and the poles.
// The pole falls at the rate sqrt((M + m) g / (M l)).
#include <saltus/analysis.hpp>
#include <saltus/saltus.hpp>

#include "runner/command_line.hpp"

namespace {

using namespace saltus;

constexpr double cart = 1.2, bob = 0.3, length = 0.5, g = 9.81;  // [kg], [kg], [m], [m/s^2]

/// A point mass on a massless rod, which stands on a cart; the angle is 0 at the top. States: position
/// [m], speed, angle [rad], rate. Input: the force on the cart [N].
class CartPole final : public LeafSystem {
 public:
  CartPole() : LeafSystem("cart") {
    declare_input_port({.name = "force"});
    declare_continuous_state(
        {.initial = Eigen::Vector4d(0.0, 0.1, 0.2, 0.0),
         .names = {"position", "speed", "angle", "rate"},
         .ode = equations<4>([](const auto& at, auto& xdot) {
           using std::cos, std::sin;
           const auto s = sin(at.x(2)), c = cos(at.x(2));
           const auto push = (at.u(0, 0) + bob * length * at.x(3) * at.x(3) * s) / (cart + bob);
           const auto turn = (g * s - c * push) / (length * (1.0 - bob / (cart + bob) * c * c));
           xdot[0] = at.x(1);
           xdot[1] = push - bob * length / (cart + bob) * turn * c;
           xdot[2] = at.x(3);
           xdot[3] = turn;
         })});
  }
};

void show(double angle) {
  const CartPole pole;
  const Context start = pole.create_context().with_continuous_state({0.0, 0.1, angle, 0.0});
  const OperatingPoint point =
      trim(pole, start,
           {.free = {{{.name = "force"}, {.name = "speed"}, {.name = "angle"}, {.name = "rate"}}},
            .hold = {"position"}});
  std::cout << point;
  if (!point.success()) throw Error(point.message);
  const Linearization lin = linearize(pole, point.context, {.inputs = point.inputs});
  const double exact = std::sqrt((cart + bob) * g / (cart * length));
  std::cout << "the largest pole is " << lin.poles().real().maxCoeff() << " /s, standing it is "
            << exact << " /s\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A pole on a cart: its equilibrium, and how fast it falls from there.", "linearize");
  double angle = 0.2;
  app.add_option("--angle", angle, "at which the search begins [rad]")->capture_default_str();
  return examples::guarded(app, argc, argv, [&] { show(angle); });
}
