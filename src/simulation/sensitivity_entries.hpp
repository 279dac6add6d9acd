// The entries of a context by which a run is differentiated.
#pragma once

#include <string>
#include <vector>

#include "saltus/model/context_entry.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// A parameter or a start value by which the run is differentiated.
struct SensitivityEntry {
  std::string name;
  ContextEntry entry;
};

/// The entries of the option `sensitivity`, a vector entry by entry. Throws ModelError for a name
/// that is unknown, named twice, or that has no derivative.
std::vector<SensitivityEntry> chosen_entries(const std::vector<std::string>& names,
                                             const Layout& layout);

/// Throws ModelError for a plan with a part that has no derivatives here.
void require_sensitivities(const Plan& plan);

}  // namespace saltus
