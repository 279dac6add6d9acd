// How much do stiff scenes cost at tight tolerances and with resets? The best of radau and bdf
// against a plain CVODE loop with the same Jacobian, at equal achieved error, on the stiff scenes
// of the shelf; and radau against bdf where events restart the method. Costs between two tolerances
// are interpolated in the logarithms. Arguments: names of scenes; none means all.
#include <span>

#include "ladder.hpp"
#include "peer_shelf.hpp"
#include "peer_sundials.hpp"
#include "sheet.hpp"
#include "stiff_scenes.hpp"

namespace {

using namespace bench;
using saltus::Method;

constexpr double longest = 2.0;  // [s] of a run, beyond which a solver is not tightened
constexpr double budget = 1.0;   // [s] of timing for each scene, in turns

/// A scene without its resets is compared at these errors, one with resets at those.
constexpr double smooth_levels[] = {1e-8, 1e-10}, hybrid_levels[] = {1e-6, 1e-8};

/// null instead of infinity, which JSON does not have.
Row shown(double cost) { return std::isfinite(cost) ? Row(cost) : Row(nullptr); }

/// The results over all scenes.
struct Found {
  std::vector<double> ratios = {};
  int missed = 0;
};

/// A row for this error. `all` are radau, bdf and, if there are three, CVODE, which is the floor;
/// else bdf is.
void judge(Sheet& sheet, Found& found, const std::string& scene, double level,
           const std::vector<Ladder>& all) {
  std::vector<const Ladder*> ours{&all[0]};
  if (all.size() > 2) ours.push_back(&all[1]);
  const double ratio = ratio_at(level, ours, {&all.back()});
  Row row{{"scene", scene}, {"at error", level}};
  for (const Ladder& ladder : all)
    row[ladder.name() + " [ms]"] = shown(ladder.at(level, milliseconds));
  for (const Ladder& ladder : all) row[ladder.name() + " calls"] = shown(ladder.at(level, calls));
  row["ratio"] = shown(ratio);
  sheet.add(row);
  if (std::isfinite(ratio))
    found.ratios.push_back(ratio);
  else
    ++found.missed;
}

void against_cvode(Sheet& sheet, Found& found, const StiffScene& scene) {
  std::vector<Ladder> all;
  const double loosest = 1e-6, enough = smooth_levels[1];
  for (const Method method : {Method::radau, Method::bdf})
    all.emplace_back(
        std::string(to_string(method)),
        [&](double rtol) { return std::make_unique<SaltusPeer>(scene, method, rtol); }, loosest,
        enough, longest);
  all.emplace_back(
      "CVODE", [&](double rtol) { return std::make_unique<CvodePeer>(scene, rtol); }, loosest,
      enough, longest);
  time_in_turns(all, budget);
  for (const double level : smooth_levels) judge(sheet, found, scene.name, level, all);
}

void against_bdf(Sheet& sheet, const std::string& name) {
  const saltus::Scene scene = saltus::models::scene(name);
  std::vector<Ladder> all;
  for (const Method method : {Method::radau, Method::bdf})
    all.emplace_back(
        std::string(to_string(method)),
        [&](double rtol) { return std::make_unique<ShelfPeer>(scene, method, rtol); }, 1e-4,
        hybrid_levels[1], longest);
  time_in_turns(all, budget);
  Found found;
  for (const double level : hybrid_levels) judge(sheet, found, name, level, all);
  sheet.target(name + ", errors of 1e-6 and 1e-8: radau against bdf, geometric mean",
               found.missed > 0 ? HUGE_VAL : geometric_mean(found.ratios), 0.3);
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char*> names(argv + 1, static_cast<std::size_t>(argc - 1));
  const auto wanted = [&](const std::string& name) {
    return names.empty() || std::ranges::count(names, name) > 0;
  };
  Sheet sheet(names.empty() ? "stiff_targets" : "stiff_targets_of_some",
              "What do stiff scenes cost at equal achieved error?");
  Found found;
  int scenes = 0;
  for (const StiffScene& scene : stiff_scenes())
    if (wanted(scene.name)) against_cvode(sheet, found, scene), ++scenes;
  if (!found.ratios.empty())
    sheet.target(saltus::text(scenes,
                              " stiff scenes, errors of 1e-8 and 1e-10: best of "
                              "radau and bdf against CVODE, geometric mean"),
                 geometric_mean(found.ratios), 0.5);
  if (names.empty())
    sheet.target("the same scenes: errors that neither radau nor bdf reaches", found.missed, 0.0);
  for (const char* name :
       {"stiff-contact", "buck-converter", "buck-parasitics", "relay-circuit", "heat-rod"})
    if (wanted(name)) against_bdf(sheet, name);
}
