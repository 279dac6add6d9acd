// How does Radau IIA compare with the other implicit methods there are in C? ARKODE's diagonally
// implicit Runge-Kutta methods, IDA on y' - f(t, y) = 0 and a plain CVODE loop, with the same f, J
// and dense matrix, on the stiff scenes of the shelf: cost at equal achieved error.
// Arguments: names of scenes; none means all. It takes some minutes.
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

/// Every run; then a line for each solver with its cost at each level, and its ratio to radau.
void compare(Sheet& sheet, const StiffScene& scene) {
  std::vector<Ladder> all = ladders(scene);
  time_in_turns(all, 3.0);
  for (const Ladder& ladder : all)
    for (const Rung& rung : ladder.rungs())
      sheet.add({{"scene", scene.name},
                 {"solver", ladder.name()},
                 {"rtol", rung.rtol},
                 {"error", rung.error},
                 {"ms", rung.time() * 1e3},
                 {"steps", rung.counts.steps},
                 {"calls", rung.counts.calls},
                 {"Jacobians", rung.counts.jacobians},
                 {"LU", rung.counts.factorisations}});
  for (const double level : levels)
    for (const Ladder& ladder : all)
      sheet.add({{"scene", scene.name},
                 {"solver", ladder.name()},
                 {"at error", level},
                 {"ms", ladder.at(level, [](const Rung& r) { return r.time() * 1e3; })},
                 {"time to radau's", 1.0 / ratio_at(level, {&all[0]}, {&ladder})},
                 {"calls", ladder.at(level, [](const Rung& r) { return double(r.counts.calls); })},
                 {"LU", ladder.at(level, [](const Rung& r) {
                    return std::max(1.0, double(r.counts.factorisations));
                  })}});
}

}  // namespace

int main(int argc, char** argv) {
  Sheet sheet("stiff_peers", "How does Radau IIA compare with ARKODE, IDA and CVODE?");
  const std::span<char*> names(argv + 1, static_cast<std::size_t>(argc - 1));
  for (const StiffScene& scene : stiff_scenes())
    if (names.empty() || std::ranges::count(names, scene.name) > 0) compare(sheet, scene);
}
