// The steady walk of a rimless wheel: its period, and how fast deviations from it die out. The square
// of the rate keeps the part cos^2(2 alpha) of a deviation in each step, alpha = pi / 8.
#include <saltus/analysis.hpp>
#include <saltus/models/rimless_wheel.hpp>

#include "runner/command_line.hpp"

namespace {

void show(int steps, saltus::Method method) {
  const saltus::Scene wheel = saltus::models::rimless_wheel();
  saltus::PeriodicOrbitOptions options{.section = "wheel.spoke", .firings = steps};
  options.simulation.ode_solver_method = method;
  const saltus::PeriodicOrbit orbit = saltus::periodic_orbit(*wheel.system, wheel.context, options);
  std::cout << orbit;
  if (!orbit.success()) throw saltus::Error(orbit.message);
  const double error = std::abs(orbit.multipliers[0] - std::pow(0.5, steps));
  std::cout << "multiplier " << std::setprecision(9) << orbit.multipliers[0].real() << ", error "
            << error << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The steady walk of a rimless wheel, and how fast deviations die out.", "orbit");
  int steps = 1;
  std::string method = "auto";
  app.add_option("--steps", steps, "steps in a period")->capture_default_str();
  app.add_option("--method", method, "of the runs")->capture_default_str();
  return examples::guarded(app, argc, argv,
                           [&] { show(steps, examples::methods_from({method}).front()); });
}
