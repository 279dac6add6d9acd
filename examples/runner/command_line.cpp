#include "command_line.hpp"

#include <iostream>

namespace examples {

void add_settings(CLI::App& app, Settings& settings) {
  app.add_option("--rtol", settings.rtol, "relative tolerance")->capture_default_str();
  app.add_option("--atol", settings.atol, "absolute tolerance")->capture_default_str();
  app.add_option("--method", settings.method, "auto, dopri5, dop853, adams, bdf")
      ->capture_default_str();
  app.add_option("--csv", settings.csv, "write the recorded rows, or the report, to FILE")
      ->option_text("FILE");
  app.add_option("--json", settings.json, "write events and statistics, or the report, to FILE")
      ->option_text("FILE");
  app.add_flag("--report", settings.report,
               "error against run time: each method that suits the scene, at rtol 1e-4 ... 1e-12");
  app.add_option("--methods", settings.methods, "methods of the report, such as dopri5,bdf")
      ->delimiter(',')
      ->option_text("NAMES");
  app.add_option("--rtols", settings.rtols, "relative tolerances of the report")
      ->delimiter(',')
      ->option_text("NUMBERS");
}

int guarded(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
  try {
    app.parse(argc, argv);
    body();
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    std::cerr << app.get_name() << ": " << error.what() << "\n";
    return 2;
  } catch (const saltus::SimulationError& error) {
    std::cerr << app.get_name() << ": " << error.what() << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << "\n";
    return 2;
  }
}

}  // namespace examples
