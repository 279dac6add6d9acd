#include "settings.hpp"

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <saltus/report/table.hpp>

#include "output.hpp"

namespace examples {

namespace {

std::ofstream opened(const std::string& file) {
  std::ofstream out(file);
  if (!out) throw saltus::Error("cannot write to '" + file + "'");
  return out;
}

}  // namespace

void run_once(saltus::Scene scene, const Settings& settings) {
  if (!settings.csv.empty()) scene.options.save_steps = true;
  const saltus::Results results = simulate(scene);
  print_summary(std::cout, scene, results);
  if (!settings.csv.empty()) {
    auto out = opened(settings.csv);
    write_rows(out, results);
  }
  if (!settings.json.empty()) opened(settings.json) << to_json(scene, results).dump(1) << "\n";
}

std::vector<saltus::Method> methods_from(const std::vector<std::string>& names) {
  std::vector<saltus::Method> methods;
  for (const std::string& name : names) methods.push_back(saltus::method_from(name));
  return methods;
}

void run_report(const saltus::Scene& scene, const Settings& settings, const std::string& title) {
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

}  // namespace examples
