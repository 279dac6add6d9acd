// Robertson's reaction: eleven decades of time in a few hundred steps, with a method for stiff
// scenes.
#include <saltus/models/robertson.hpp>

#include "runner/runner.hpp"

int main(int argc, char** argv) {
  saltus::models::RobertsonParameters with;
  const std::vector<examples::Option> options{
      {"--k1", with.k1, "rate of A -> B [1/s]"},
      {"--k2", with.k2, "rate of B + C -> A + C [1/s]"},
      {"--k3", with.k3, "rate of 2 B -> B + C [1/s]"},
  };
  return examples::run(
      argc, argv, {"robertson", "Robertson's stiff reaction, against a reference of 16 digits."},
      options, with.t_end, [&] { return saltus::models::robertson(with); });
}
