// Robertson's reaction: eleven decades of time in a few hundred steps, with a method for stiff
// scenes.
#include <saltus/models/robertson.hpp>

#include "runner.hpp"

using saltus::models::RobertsonParameters;

int main(int argc, char** argv) {
  const auto add = [](CLI::App& app, RobertsonParameters& with) {
    app.add_option("--k1", with.k1, "rate of A -> B [1/s]")->capture_default_str();
    app.add_option("--k2", with.k2, "rate of B + C -> A + C [1/s]")->capture_default_str();
    app.add_option("--k3", with.k3, "rate of 2 B -> B + C [1/s]")->capture_default_str();
  };
  return examples::run(argc, argv, "robertson",
                       "Robertson's stiff reaction, against a reference of 16 digits.", add,
                       &saltus::models::robertson);
}
