// The shelf: every ready scene by name, run once or as a report of error against run time.
#include <saltus/models/shelf.hpp>

#include "runner/command_line.hpp"

namespace {

using saltus::models::shelf;

void list() {
  std::size_t widest = 0;
  for (const auto& entry : shelf()) widest = std::max(widest, entry.name.size());
  for (const auto& entry : shelf())
    std::cout << std::left << std::setw(static_cast<int>(widest) + 2) << entry.name << entry.title
              << "\n";
}

/// The scene with its usual options, changed by those of the command line.
saltus::Scene chosen(const std::string& name, const CLI::App& app,
                     const examples::Settings& settings) {
  saltus::Scene scene = saltus::models::scene(name);
  if (app.count("--rtol") > 0) scene.options.rtol = settings.rtol;
  if (app.count("--atol") > 0) scene.options.atol = settings.atol;
  if (app.count("--method") > 0)
    scene.options.ode_solver_method = saltus::method_from(settings.method);
  scene.name = name;
  return scene;
}

std::string title_of(const std::string& name) {
  return std::ranges::find(shelf(), name, &saltus::models::ShelfEntry::name)->title;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Ready scenes: lists them, runs one, or reports its error against run time.",
               "shelf");
  std::string name;
  examples::Settings settings;
  app.add_option("scene", name, "its name; none lists them all")->option_text("NAME");
  examples::add_settings(app, settings);
  return examples::guarded(app, argc, argv, [&] {
    if (name.empty()) return list();
    const saltus::Scene scene = chosen(name, app, settings);
    settings.report ? examples::run_report(scene, settings, title_of(name))
                    : examples::run_once(scene, settings);
  });
}
