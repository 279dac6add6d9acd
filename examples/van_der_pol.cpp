// Van der Pol's oscillator: stiff between its jumps.
#include <saltus/models/van_der_pol.hpp>

#include "runner/runner.hpp"

int main(int argc, char** argv) {
  saltus::models::VanDerPolParameters with;
  const std::vector<examples::Option> options{
      {"--mu", with.mu, "strength of the damping; a reference is known for 1000"},
      {"--x0", with.x0, "x at the start"},
      {"--v0", with.v0, "dx/dt at the start"},
  };
  return examples::run(
      argc, argv, {"van_der_pol", "Van der Pol's oscillator, against the value of the literature."},
      options, with.t_end, [&] { return saltus::models::van_der_pol(with); });
}
