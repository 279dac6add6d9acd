// Error against run time of every scene of the shelf, by each method that suits it at five
// tolerances, into build/bench/results/shelf. Arguments: names of scenes; none means all.
#include <chrono>
#include <iostream>
#include <saltus/models/shelf.hpp>
#include <saltus/report/table.hpp>
#include <saltus/report/written.hpp>
#include <span>

#include "sheet.hpp"

namespace {

/// Short runs are repeated for 40 ms, and long runs are stopped after two seconds, so the whole
/// shelf takes about a minute. The row of a stopped run says so.
saltus::WorkOptions options() {
  saltus::WorkOptions work;
  work.timing = {.least_time = 0.04, .most_repeats = 2000, .most_cold = 3};
  work.time_limit = 2.0;
  return work;
}

void report(const saltus::models::ShelfEntry& entry) {
  const auto start = std::chrono::steady_clock::now();
  saltus::Scene scene = saltus::models::scene(entry.name);
  scene.name = entry.name;
  saltus::WorkReport found = work_precision(scene, options());
  found.title = entry.title;
  std::ofstream out(bench::results_folder() / "shelf" / (entry.name + ".json"));
  write_json(out, found);
  const auto failed = std::ranges::count_if(
      found.rows, [](const saltus::WorkRow& row) { return !ended_well(row.status); });
  std::printf("  %-22s %3zu runs, %2td failed, %5.1f s\n", entry.name.c_str(), found.rows.size(),
              failed, saltus::detail::seconds_since(start));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::create_directories(bench::results_folder() / "shelf");
  const std::span<char*> names(argv + 1, argv + argc);
  for (const auto& entry : saltus::models::shelf())
    if (names.empty() || std::ranges::count(names, entry.name) > 0) report(entry);
}
