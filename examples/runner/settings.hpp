// The options of every example, and the two things it does with a scene: one run, or a report.
#pragma once

#include <saltus/report/written.hpp>
#include <string>
#include <vector>

namespace examples {

/// The options of every example. The defaults are those of the scene.
struct Settings {
  double rtol = 1e-6;
  double atol = 1e-8;
  std::string method = "auto";
  std::string csv = {}, json = {};
  bool report = false;
  std::vector<std::string> methods = {};  // of the report; empty: all that suit the scene
  std::vector<double> rtols = saltus::WorkOptions().rtols;
};

/// One run: a summary on the screen, and the files that the settings name.
void run_once(saltus::Scene scene, const Settings& settings);

/// Error against run time, on the screen and in the files that the settings name.
void run_report(const saltus::Scene& scene, const Settings& settings,
                const std::string& title = {});

std::vector<saltus::Method> methods_from(const std::vector<std::string>& names);

}  // namespace examples
