// Event log: events and their times by name.
#include "saltus/simulation/event_log.hpp"

#include <algorithm>

#include "saltus/base/error.hpp"

namespace saltus {

Event EventLog::operator[](std::size_t i) const {
  const Row& row = rows_[i];
  const auto [block, name] = split(names_[static_cast<std::size_t>(row.source)]);
  return {row.time,
          row.jump,
          row.kind,
          row.direction,
          block,
          name,
          row.predicted,
          std::span(states_).subspan(row.states, row.width),
          std::span(states_).subspan(row.states + row.width, row.width),
          row.entry};
}

std::vector<double> EventLog::times(std::string_view name, EventKind kind) const {
  require(name);
  std::vector<double> found;
  for (const Row& row : rows_) {
    if (row.kind == kind && is_called(names_[static_cast<std::size_t>(row.source)], name))
      found.push_back(row.time);
  }
  return found;
}

EventLog EventLog::emptied() const {
  EventLog log;
  log.names_ = names_;
  return log;
}

void EventLog::shorten(std::size_t n) {
  if (n >= rows_.size()) return;
  states_.resize(rows_[n].states);
  rows_.resize(n);
}

bool EventLog::is_called(std::string_view full, std::string_view name) {
  return full == name || split(full).second == name;
}

void EventLog::require(std::string_view name) const {
  const auto has_name = [&](const std::string& full) { return is_called(full, name); };
  if (std::ranges::any_of(names_, has_name)) return;
  std::vector<std::string> known;  // names as short or as long as the requested name
  for (const std::string& full : names_) {
    const bool whole = name.find('.') != std::string_view::npos;
    std::string one(whole ? full : split(full).second);
    if (std::ranges::find(known, one) == known.end()) known.push_back(std::move(one));
  }
  throw ModelError(text("no event is called '", name, "'", known_names(name, known)));
}

std::pair<std::string_view, std::string_view> EventLog::split(std::string_view full) {
  const auto dot = full.rfind('.');
  return dot == std::string_view::npos ? std::pair{full, std::string_view()}
                                       : std::pair{full.substr(0, dot), full.substr(dot + 1)};
}

}  // namespace saltus
