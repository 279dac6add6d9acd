#include "runner.hpp"

#include "command_line.hpp"

namespace examples {

namespace {

Settings defaults_of(const saltus::Scene& scene) {
  return {.rtol = scene.options.rtol,
          .atol = scene.options.atol,
          .method = std::string(to_string(scene.options.ode_solver_method))};
}

void run_with(const Settings& settings, double t_end, const std::function<saltus::Scene()>& make) {
  const saltus::Method method = saltus::method_from(settings.method);  // before any work
  if (!(t_end >= 0.0)) {
    throw saltus::ModelError(saltus::text("--t-end: expected a time >= 0 s, found ", t_end));
  }
  saltus::Scene scene = make();
  scene.options.rtol = settings.rtol;
  scene.options.atol = settings.atol;
  scene.options.ode_solver_method = method;
  settings.report ? run_report(scene, settings) : run_once(scene, settings);
}

}  // namespace

int run(int argc, char** argv, const Program& program, const std::vector<Option>& options,
        double& t_end, const std::function<saltus::Scene()>& make) {
  Settings settings = defaults_of(make());
  CLI::App app(program.about, program.name);
  for (const Option& option : options) {
    app.add_option(option.name, option.value, option.about)->capture_default_str();
  }
  app.add_option("--t-end", t_end, "end of the run [s]")->capture_default_str();
  add_settings(app, settings);
  return guarded(app, argc, argv, [&] { run_with(settings, t_end, make); });
}

}  // namespace examples
