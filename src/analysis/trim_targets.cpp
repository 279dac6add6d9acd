// The equations of a search for an operating point.
#include "trim_targets.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

void require_finite_target(const std::string& where, const std::string& name, double value) {
  if (std::isfinite(value)) return;
  throw ModelError(text(where, ": '", name, "': expected a finite number, found ", value));
}

/// The name of the output that is recorded: itself, or the vector of an entry.
std::string recorded_name(const System& system, const WantedOutput& wanted) {
  const std::vector<std::string> names = system.output_names();
  const bool whole = !wanted.port.system && std::ranges::find(names, wanted.name) != names.end();
  return whole ? wanted.name : std::string(split_index(wanted.name).first);
}

/// The rows of a linearisation that a name means.
std::vector<std::string> entries_called(const std::vector<std::string>& rows,
                                        const std::string& name) {
  if (std::ranges::find(rows, name) != rows.end()) return {name};
  std::vector<std::string> entries;
  for (const std::string& row : rows)
    if (row.substr(0, row.rfind('[')) == name) entries.push_back(row);
  return entries;
}

}  // namespace

std::vector<TrimTarget> wanted_rates(const std::string& where, const System& system,
                                     const Context& context,
                                     const std::vector<WantedRate>& derivatives) {
  const std::vector<std::string> names = continuous_names(context);
  std::vector<std::optional<double>> values(names.size(), 0.0);
  for (const WantedRate& wanted : derivatives) {
    const AnalysisPlace place = place_of(where + ": derivatives", system, context, wanted.name);
    if (!place.is_state())
      throw ModelError(text(where, ": derivatives: '", wanted.name, "' is no continuous state",
                            known_names(wanted.name, names)));
    if (wanted.value) require_finite_target(where + ": derivatives", wanted.name, *wanted.value);
    nth(values, place.entry->first) = wanted.value;
  }
  std::vector<TrimTarget> targets;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (values[i])
      targets.push_back({"rate of " + names[i], true, static_cast<Index>(i), *values[i]});
  return targets;
}

RecordedSignals wanted_signals(const std::string& where, const System& system,
                               const std::vector<WantedOutput>& outputs) {
  RecordedSignals signals;
  for (const WantedOutput& wanted : outputs) {
    const std::string name = recorded_name(system, wanted);
    const OutputPort port = wanted.port.system ? wanted.port : system.output(name);
    const auto known = std::ranges::find(signals, name, &RecordedSignals::value_type::first);
    if (known == signals.end())
      signals.push_back({name, port});
    else if (known->second.system != port.system || known->second.index != port.index)
      throw ModelError(
          text(where, ": outputs: '", name, "' names two outputs; give one of them another name"));
  }
  return signals;
}

std::vector<TrimTarget> wanted_outputs(const std::string& where,
                                       const std::vector<std::string>& rows,
                                       const std::vector<WantedOutput>& outputs) {
  std::vector<TrimTarget> targets;
  for (const WantedOutput& wanted : outputs) {
    const auto entries = entries_called(rows, wanted.name);
    if (entries.empty())
      throw ModelError(text(where, ": outputs: there is no '", wanted.name, "'",
                            known_names(wanted.name, rows)));
    if (std::ssize(entries) != wanted.value.size())
      throw ModelError(text(where, ": outputs: '", wanted.name, "' has ", entries.size(),
                            " entries, found ", wanted.value.size()));
    for (Index i = 0; i < wanted.value.size(); ++i) {
      const std::string& entry = nth(entries, i);
      require_finite_target(where + ": outputs", entry, wanted.value[i]);
      const auto row = std::ranges::find(rows, entry) - rows.begin();
      targets.push_back({entry, false, row, wanted.value[i]});
    }
  }
  return targets;
}

}  // namespace saltus
