// The examples of one model: numbers of the model and options of the run on the command line.
#pragma once

#include <functional>
#include <saltus/report/written.hpp>
#include <string>
#include <vector>

namespace examples {

struct Program {
  std::string name;
  std::string about;
};

/// A number that the command line may change, and what it is, with its unit.
struct Option {
  std::string name;
  double& value;
  std::string about;
};

/// Reads the options and --t-end, and runs the scene that `make` then makes. Returns the exit code.
int run(int argc, char** argv, const Program& program, const std::vector<Option>& options,
        double& t_end, const std::function<saltus::Scene()>& make);

}  // namespace examples
