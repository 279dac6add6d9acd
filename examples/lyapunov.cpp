// The Lyapunov exponents of an oscillator with a switch, chaotic by a closed form:
//
//   u'' - 2 b u' + ((2 pi)^2 + b^2)(u - s) = 0, and s becomes the sign of u where u' = 0.
//
// The exponents are b and 0 (N. Corron, J. Blakely, M. Stahl, Chaos 20 (2010) 023123).
#include <saltus/analysis.hpp>
#include <saltus/saltus.hpp>

#include "runner/command_line.hpp"

namespace {

using namespace saltus;

/// States: u, u'. Discrete state: s, -1 or 1.
class Oscillator final : public LeafSystem {
 public:
  explicit Oscillator(double b) : LeafSystem("oscillator") {
    const double stiffness = std::pow(6.283185307179586, 2) + b * b;  // [1/s^2]
    declare_continuous_state(
        {.initial = Eigen::Vector2d(0.4, 0.0), .ode = [b, stiffness](const At& at, VectorRef xdot) {
           xdot << at.x[1], 2.0 * b * at.x[1] - stiffness * (at.x[0] - at.z[0]);
         }});
    declare_discrete_state(Eigen::VectorXd::Constant(1, 1.0));
    declare_zero_crossing(
        {.name = "top",
         .guard = [](const At& at) { return at.x[1]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.x[0] >= 0.0 ? 1.0 : -1.0}); },
         .direction = Direction::crosses_zero});
  }
};

void show(double b, double time) {
  const Oscillator system(b);
  const LyapunovSpectrum found =
      lyapunov(system, system.create_context(), {.time = time, .transient = 10.0});
  std::cout << found << "exact: " << b << " and 0 1/s, error " << std::abs(found.exponents[0] - b)
            << " 1/s\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The Lyapunov exponents of a chaotic oscillator with a switch.", "lyapunov");
  double b = 0.5, time = 300.0;
  app.add_option("--b", b, "growth of the oscillation [1/s]")->capture_default_str();
  app.add_option("--time", time, "length of the run [s]")->capture_default_str();
  return examples::guarded(app, argc, argv, [&] { show(b, time); });
}
