// The four scenes of the tutorial "Bouncing Ball": first with the tutorial's own tolerances and
// step bounds, then as error against run time without the bounds.
#include <saltus/models/tutorial.hpp>
#include <saltus/report/table.hpp>

#include "runner/command_line.hpp"

namespace {

using namespace saltus;

/// Prints each rest of the ball: its beginning, the distance of this from the closed form, and its
/// end.
void print_rests(const Scene& scene, const Results& results) {
  const EventTimes& exact = scene.exact.events.front();
  const auto found = observed_series(results.events, exact.guard);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!std::isfinite(found[i].accumulation)) continue;
    std::cout << "  Zeno: at rest from t = " << std::setprecision(12) << found[i].accumulation
              << " s";
    if (i < exact.series.size()) {
      std::cout << ", error "
                << detail::short_number(
                       std::abs(found[i].accumulation - exact.series[i].accumulation))
                << " s";
    }
    if (std::isfinite(found[i].release))
      std::cout << "; released at t = " << found[i].release << " s";
    std::cout << "\n";
  }
}

void show(const Scene& scene) {
  const Results results = simulate(scene);
  const Achieved a = achieved(scene, results);
  std::size_t bounces = 0;
  for (const EventSeries& series :
       observed_series(results.events, scene.exact.events.front().guard)) {
    bounces += series.times.size();
  }
  std::cout << scene.name << "\n  " << to_string(results.status) << ", " << bounces << " bounces, "
            << results.time.size() << " rows; worst event time "
            << detail::short_number(a.event_error) << " s, worst height or velocity "
            << detail::short_number(a.error) << ", events off " << a.event_mismatch << "\n";
  print_rests(scene, results);
}

/// Compares the scene as it is with the scene without bounds of steps, which no method needs.
void compare(Scene scene, const WorkOptions& work) {
  const Reference reference = reference_for(scene, {});
  std::vector<WorkRow> rows{measure(scene, scene.options, reference, work)};
  rows.front().method += " *";
  scene.options.max_minor_step_size = scene.options.max_major_step_length =
      std::numeric_limits<double>::infinity();
  for (const WorkRow& row : work_precision(scene, work).rows) rows.push_back(row);
  write_text(std::cout, rows);
  std::cout << "  * with the tutorial's tolerances and bounds of steps\n\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The four scenes of the tutorial: events, errors against the closed form, error against run "
      "time.",
      "tutorial");
  std::vector<std::string> methods{"dopri5", "adams"};
  WorkOptions work{.rtols = {1e-4, 1e-8, 1e-12}, .atol_over_rtol = 1e-2, .time_limit = 1.0};
  app.add_option("--methods", methods, "methods to compare")->capture_default_str();
  app.add_option("--rtols", work.rtols, "relative tolerances to compare at")->capture_default_str();
  return examples::guarded(app, argc, argv, [&] {
    work.methods = examples::methods_from(methods);
    for (const Scene& scene : models::tutorial()) {
      show(scene);
      compare(scene, work);
    }
  });
}
