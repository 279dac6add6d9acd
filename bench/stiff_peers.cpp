// How does Radau IIA compare with the other implicit methods there are in C? ARKODE's diagonally
// implicit Runge-Kutta methods, IDA on y' - f(t, y) = 0 and a plain CVODE loop, with the same f, J
// and dense matrix, on the stiff scenes of the shelf: cost at equal achieved error.
// LU counts factorisations; one of radau is of a real matrix and one to three complex ones.
// Arguments: names of scenes; none means all. It takes some minutes.
#include <functional>
#include <span>

#include "ladder.hpp"
#include "peer_arkode.hpp"
#include "peer_ida.hpp"
#include "sheet.hpp"
#include "stiff_scenes.hpp"

namespace {

using namespace bench;

constexpr double levels[] = {1e-4, 1e-6, 1e-8, 1e-10};
constexpr double longest = 4.0;  // [s] of a run, beyond which a solver is not tightened

/// Tables of orders 3, 4 and 5; all but SDIRK_5_3_4 have an explicit first stage, and all are
/// L-stable.
constexpr const char* tables[] = {"ESDIRK325L2SA_5_2_3", "SDIRK_5_3_4", "ESDIRK437L2SA_7_3_4",
                                  "ESDIRK547L2SA2_7_4_5"};

std::vector<Ladder> ladders(const StiffScene& scene) {
  std::vector<Ladder> all;
  const auto add = [&](std::string name, const MakePeer& make) {
    all.emplace_back(std::move(name), make, 1e-4, levels[3], longest);
  };
  for (const auto method : {saltus::Method::radau, saltus::Method::bdf})
    add(saltus::text("saltus ", to_string(method)),
        [&](double rtol) { return std::make_unique<SaltusPeer>(scene, method, rtol); });
  add("CVODE", [&](double rtol) { return std::make_unique<CvodePeer>(scene, rtol); });
  add("IDA", [&](double rtol) { return std::make_unique<IdaPeer>(scene, rtol); });
  for (const std::string table : tables)
    add(table, [&](double rtol) { return std::make_unique<ArkodePeer>(scene, table, rtol); });
  return all;
}

double factorisations(const Rung& rung) {
  return std::max(1.0, static_cast<double>(rung.counts.factorisations));
}

/// Of one solver at one level, over the scenes where it and radau reach it.
struct Means {
  std::vector<double> times = {}, calls = {};
};
using AllMeans = std::map<std::pair<double, std::string>, Means, std::greater<>>;

void show_runs(Sheet& sheet, const std::string& scene, const std::vector<Ladder>& all) {
  for (const Ladder& ladder : all)
    for (const Rung& rung : ladder.rungs())
      sheet.add({{"scene", scene},
                 {"solver", ladder.name()},
                 {"rtol", rung.rtol},
                 {"error", rung.error},
                 {"ms", milliseconds(rung)},
                 {"steps", rung.counts.steps},
                 {"calls", rung.counts.calls},
                 {"Jacobians", rung.counts.jacobians},
                 {"LU", rung.counts.factorisations}});
}

/// A solver's cost at a level of error, and its ratio to that of radau, the first.
void show_cost(Sheet& sheet, AllMeans& means, const std::string& scene, double level,
               const Ladder& radau, const Ladder& ladder) {
  const bool reached =
      std::isfinite(ladder.at(level, calls)) && std::isfinite(radau.at(level, calls));
  const double time = reached ? 1.0 / ratio_at(level, {&radau}, {&ladder}) : HUGE_VAL;
  sheet.add({{"scene", scene},
             {"solver", ladder.name()},
             {"at error", level},
             {"ms", ladder.at(level, milliseconds)},
             {"time to radau's", time},
             {"calls", ladder.at(level, calls)},
             {"LU", ladder.at(level, factorisations)}});
  if (!reached) return;
  Means& here = means[{level, ladder.name()}];
  here.times.push_back(time);
  here.calls.push_back(ladder.at(level, calls) / radau.at(level, calls));
}

void compare(Sheet& sheet, AllMeans& means, const StiffScene& scene) {
  std::vector<Ladder> all = ladders(scene);
  time_in_turns(all, 3.0);
  show_runs(sheet, scene.name, all);
  for (const double level : levels)
    for (const Ladder& ladder : all) show_cost(sheet, means, scene.name, level, all[0], ladder);
}

void show_means(Sheet& sheet, const AllMeans& means) {
  for (const auto& [key, here] : means)
    sheet.add({{"geometric mean", key.second},
               {"at error", key.first},
               {"scenes", here.times.size()},
               {"time to radau's", geometric_mean(here.times)},
               {"calls to radau's", geometric_mean(here.calls)}});
}

}  // namespace

int main(int argc, char** argv) {
  Sheet sheet("stiff_peers", "How does Radau IIA compare with ARKODE, IDA and CVODE?");
  const std::span<char*> names(argv + 1, static_cast<std::size_t>(argc - 1));
  AllMeans means;
  for (const StiffScene& scene : stiff_scenes())
    if (names.empty() || std::ranges::count(names, scene.name) > 0) compare(sheet, means, scene);
  show_means(sheet, means);
}
