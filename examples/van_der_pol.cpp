// Van der Pol's oscillator: stiff between its jumps.
#include <saltus/models/van_der_pol.hpp>

#include "runner.hpp"

using saltus::models::VanDerPolParameters;

int main(int argc, char** argv) {
  const auto add = [](CLI::App& app, VanDerPolParameters& with) {
    app.add_option("--mu", with.mu, "strength of the damping; a reference is known for 1000")
        ->capture_default_str();
    app.add_option("--x0", with.x0, "x at the start")->capture_default_str();
    app.add_option("--v0", with.v0, "dx/dt at the start")->capture_default_str();
  };
  return examples::run(argc, argv, "van_der_pol",
                       "Van der Pol's oscillator, against the value of the literature.", add,
                       &saltus::models::van_der_pol);
}
