// What does "auto" cost against the best fixed method, on every quick scene of the shelf? Each
// method runs at the scene's own tolerances; a method that takes longer than a second is left out.
#include <saltus/models/shelf.hpp>
#include <saltus/report/work_precision.hpp>

#include "interleave.hpp"
#include "runner.hpp"
#include "sheet.hpp"

namespace {

using bench::Runner;

/// Whether the scene reaches its end by this method within the second.
bool ends(const saltus::Scene& scene, saltus::Method method) {
  saltus::SimulatorOptions options = saltus::detail::bounded(scene.options, 1.0);
  options.ode_solver_method = method, options.recorded_signals.clear(), options.save_at.clear();
  options.save_steps = false;
  return ended_well(simulate(*scene.system, scene.context, scene.span, options).status);
}

/// Returns the ratio; infinite if auto fails, 0 if no fixed method reaches the end.
double compare(bench::Sheet& sheet, const std::string& name) {
  const saltus::Scene scene = saltus::models::scene(name);
  std::vector<std::unique_ptr<Runner>> runners;
  std::vector<saltus::Method> methods;
  std::vector<std::function<void()>> turns;
  const auto add = [&](saltus::Method method) {
    if (!ends(scene, method)) return;
    methods.push_back(method);
    runners.push_back(std::make_unique<Runner>(scene, method));
    turns.push_back([&run = *runners.back()] { run(); });
  };
  add(saltus::Method::automatic);
  if (methods.empty()) {
    sheet.add({{"scene", name}, {"rtol", scene.options.rtol.smallest()}, {"auto chose", "failed"}});
    return std::numeric_limits<double>::infinity();
  }
  for (saltus::Method method : scene.methods)
    if (method != saltus::Method::automatic) add(method);
  const auto times = bench::interleave(turns, 9, 1e-3);
  // Ratios are to auto, the first: the best method has the smallest.
  std::size_t best = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (best == 0 || times[i].ratio < times[best].ratio) best = i;
  const double ratio = best == 0 ? 0.0 : 1.0 / times[best].ratio;
  sheet.add({{"scene", name},
             {"rtol", scene.options.rtol.smallest()},
             {"auto chose", runners[0]->statistics().method.substr(0, 40)},
             {"best", best == 0 ? "none" : to_string(methods[best])},
             {"auto [us]", times[0].time * 1e6},
             {"best [us]", times[best].time * 1e6},
             {"ratio", ratio},
             {"auto's steps", runners[0]->statistics().steps},
             {"best's steps", runners[best]->statistics().steps}});
  return ratio;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    bench::Sheet sheet("auto_of_one", "auto against the best fixed method");
    for (int i = 1; i < argc; ++i) compare(sheet, argv[i]);
    return 0;
  }
  bench::Sheet sheet("auto_or_best", "What does auto cost, against the best fixed method?");
  std::vector<std::pair<double, std::string>> ratios;
  for (const auto& entry : saltus::models::shelf())
    if (entry.quick) ratios.emplace_back(compare(sheet, entry.name), entry.name);
  const auto [most, name] = *std::ranges::max_element(ratios);
  sheet.target(saltus::text("auto against the best fixed method, worst of ", ratios.size(),
                            " scenes (", name, ")"),
               most, 1.3);
}
