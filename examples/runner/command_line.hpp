// The command line of the examples.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "settings.hpp"

namespace examples {

void add_settings(CLI::App& app, Settings& settings);

/// Reads the command line and runs `body`. An error becomes one line and an exit code: 2 for bad
/// input, 1 for a run that failed.
int guarded(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

}  // namespace examples
