// The common part of the examples: options of the command line, one run with a summary, files, the
// report.
#pragma once

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <saltus/report/table.hpp>
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

inline void add_settings(CLI::App& app, Settings& settings) {
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

inline std::ofstream opened(const std::string& file) {
  std::ofstream out(file);
  if (!out) throw saltus::Error("cannot write to '" + file + "'");
  return out;
}

// --- one run -----------------------------------------------------------------------------------

inline void print_events(std::ostream& out, const saltus::EventLog& events) {
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(most, events.size()); ++i) {
    const saltus::Event event = events[i];
    out << "  t = " << std::setprecision(15) << event.time << " s  " << event.block << "."
        << event.name << "  " << to_string(event.kind) << "\n";
  }
  if (events.size() > most) out << "  ... and " << events.size() - most << " more\n";
}

inline void print_summary(std::ostream& out, const saltus::Scene& scene,
                          const saltus::Results& results) {
  using saltus::detail::short_number, saltus::detail::short_time;
  const saltus::Statistics& s = results.statistics;
  const saltus::Achieved a = achieved(scene, results);
  out << scene.name << ": " << to_string(results.status) << " at t = " << results.context.time()
      << " s, method " << s.method << "\n"
      << results.events.size() << " events\n";
  print_events(out, results.events);
  out << "max error " << short_number(a.error) << ", worst event time "
      << short_number(a.event_error) << " s, events off " << a.event_mismatch << "\n  against: "
      << (scene.exact.provenance.empty() ? "nothing, the answer is not known"
                                         : scene.exact.provenance)
      << "\n";
  out << s.steps << " steps, " << s.rejected << " rejected, " << s.restarts << " restarts, "
      << s.right_hand_side_calls << " right-hand-side, " << s.guard_calls << " guard and "
      << s.jacobian_calls << " Jacobian calls, " << short_time(s.wall_time) << "\n";
}

/// Writes time, pass, and the recorded signals, with one line for each row.
inline void write_rows(std::ostream& out, const saltus::Results& results) {
  out << std::setprecision(17) << "time,jump";
  for (const auto& signal : results.signals) {
    for (saltus::Index i = 0; i < signal.shape.size; ++i) {
      out << "," << signal.name;
      if (signal.shape.vector) out << "_" << i;
    }
  }
  out << "\n";
  for (std::size_t row = 0; row < results.time.size(); ++row) {
    out << results.time[row] << "," << results.jump[row];
    const Eigen::VectorXd values = saltus::detail::row_of(results, row);
    for (const double value : values) out << "," << value;
    out << "\n";
  }
}

inline nlohmann::json to_json(const saltus::Scene& scene, const saltus::Results& results) {
  const saltus::Statistics& s = results.statistics;
  const saltus::Achieved a = achieved(scene, results);
  nlohmann::json events = nlohmann::json::array();
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const saltus::Event e = results.events[i];
    events.push_back({{"time", e.time},
                      {"jump", e.jump},
                      {"block", e.block},
                      {"name", e.name},
                      {"kind", to_string(e.kind)},
                      {"direction", e.direction},
                      {"predicted", e.predicted},
                      {"before", std::vector(e.before.begin(), e.before.end())},
                      {"after", std::vector(e.after.begin(), e.after.end())}});
  }
  return {{"scene", scene.name},
          {"status", to_string(results.status)},
          {"time", results.context.time()},
          {"method", s.method},
          {"events", events},
          {"achieved",
           {{"error", a.error},
            {"event_error", a.event_error},
            {"event_mismatch", a.event_mismatch},
            {"accumulation_error", a.accumulation_error},
            {"release_error", a.release_error},
            {"against", scene.exact.provenance}}},
          {"statistics",
           {{"steps", s.steps},
            {"rejected", s.rejected},
            {"restarts", s.restarts},
            {"right_hand_side_calls", s.right_hand_side_calls},
            {"guard_calls", s.guard_calls},
            {"jacobian_calls", s.jacobian_calls},
            {"wall_time", s.wall_time}}}};
}

inline void run_once(saltus::Scene scene, const Settings& settings) {
  if (!settings.csv.empty()) scene.options.save_steps = true;
  const saltus::Results results = simulate(scene);
  print_summary(std::cout, scene, results);
  if (!settings.csv.empty()) {
    auto out = opened(settings.csv);
    write_rows(out, results);
  }
  if (!settings.json.empty()) opened(settings.json) << to_json(scene, results).dump(1) << "\n";
}

inline std::vector<saltus::Method> methods_from(const std::vector<std::string>& names) {
  std::vector<saltus::Method> methods;
  for (const std::string& name : names) methods.push_back(saltus::method_from(name));
  return methods;
}

// --- the report --------------------------------------------------------------------------------

inline void run_report(const saltus::Scene& scene, const Settings& settings,
                       const std::string& title = {}) {
  saltus::WorkReport report = saltus::work_precision(
      scene, {.methods = methods_from(settings.methods), .rtols = settings.rtols});
  report.title = title;
  write_text(std::cout, report);
  if (!settings.csv.empty()) {
    auto out = opened(settings.csv);
    write_csv(out, report);
  }
  if (!settings.json.empty()) {
    auto out = opened(settings.json);
    write_json(out, report);
  }
}

// --- main --------------------------------------------------------------------------------------

/// Runs `body`. An error becomes one line and an exit code: 2 for bad input, 1 for a run that
/// failed.
template <class Body>
int guarded(CLI::App& app, int argc, char** argv, Body&& body) {
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

/// Runs an example of one model. `add` declares the options of the parameters, `make` makes the
/// scene.
template <class Parameters, class Add>
int run(int argc, char** argv, const std::string& name, const std::string& about, Add&& add,
        saltus::Scene (*make)(const Parameters&)) {
  Parameters parameters;
  const saltus::SimulatorOptions defaults = make(parameters).options;
  Settings settings{.rtol = defaults.rtol,
                    .atol = defaults.atol,
                    .method = std::string(to_string(defaults.ode_solver_method))};
  CLI::App app(about, name);
  add(app, parameters);
  app.add_option("--t-end", parameters.t_end, "end of the run [s]")->capture_default_str();
  add_settings(app, settings);
  return guarded(app, argc, argv, [&] {
    const saltus::Method method = saltus::method_from(settings.method);  // before any work
    if (!(parameters.t_end >= 0.0)) {
      throw saltus::ModelError(
          saltus::text("--t-end: expected a time >= 0 s, found ", parameters.t_end));
    }
    saltus::Scene scene = make(parameters);
    scene.options.rtol = settings.rtol;
    scene.options.atol = settings.atol;
    scene.options.ode_solver_method = method;
    settings.report ? run_report(scene, settings) : run_once(scene, settings);
  });
}

}  // namespace examples
