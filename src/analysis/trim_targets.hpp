// The equations of a search for an operating point: wanted rates and outputs.
#pragma once

#include "trim_problem.hpp"

namespace saltus {

/// The rates of all states: 0, or as `derivatives` says. Throws ModelError for a name that is no
/// continuous state.
std::vector<TrimTarget> wanted_rates(const std::string& where, const System& system,
                                     const Context& context,
                                     const std::vector<WantedRate>& derivatives);

/// The outputs that have to be read. Throws ModelError for an unknown one.
RecordedSignals wanted_signals(const std::string& where, const System& system,
                               const std::vector<WantedOutput>& outputs);

/// The equations of the outputs. `rows` are the names of the outputs of a linearisation.
std::vector<TrimTarget> wanted_outputs(const std::string& where,
                                       const std::vector<std::string>& rows,
                                       const std::vector<WantedOutput>& outputs);

}  // namespace saltus
