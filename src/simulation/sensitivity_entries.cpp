#include "sensitivity_entries.hpp"

#include <algorithm>

namespace saltus {

namespace {

/// One step solves a full system of five times as many unknowns.
constexpr Index most_states = 200;

/// The first part of a plan of which no derivative is known, in words; empty if there is none.
std::string obstacle_of(const Plan& plan) {
  if (plan.nx > most_states)
    return text("the system has ", plan.nx, " continuous states, and at most ", most_states,
                " are supported");
  if (!plan.histories.empty())
    return text("block '", plan.leaf(plan.histories.front()).path,
                "' keeps a history of its input, which has no derivative here");
  return {};
}

}  // namespace

std::vector<SensitivityEntry> chosen_entries(const std::vector<std::string>& names,
                                             const Layout& layout) {
  std::vector<SensitivityEntry> all;
  for (const std::string& name : names) {
    const ContextEntry entry = find_entry(layout, name);
    if (entry.kind == ContextEntry::Kind::mode)
      throw ModelError(text("option sensitivity: '", name,
                            "' is a mode, an integer, so nothing has a derivative with respect to "
                            "it; expected a parameter or a start value"));
    for (Index i = 0; i < entry.size; ++i)
      all.push_back(
          {entry.size == 1 ? name : text(name, "[", i, "]"), {entry.kind, entry.first + i, 1}});
  }
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto same = [&](const SensitivityEntry& other) {
      return other.entry.kind == one->entry.kind && other.entry.first == one->entry.first;
    };
    if (std::any_of(all.begin(), one, same))
      throw ModelError(text("option sensitivity: '", one->name, "' is named twice"));
  }
  return all;
}

void require_sensitivities(const Plan& plan) {
  const std::string obstacle = obstacle_of(plan);
  if (!obstacle.empty())
    throw ModelError(text("option sensitivity: ", obstacle,
                          "; take differences of two runs for this system instead"));
}

}  // namespace saltus
