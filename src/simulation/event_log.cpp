// Event log: events and their times by name.
#include "saltus/simulation/event_log.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>

#include "saltus/base/error.hpp"

namespace saltus {

Event EventLog::operator[](std::size_t i) const {
  const Row& row = rows_[i];
  const EventName& source = names_[row.source];
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const bool queued = is_of_queue(row.kind);
  return {row.time,
          row.jump,
          row.kind,
          row.direction,
          source.block,
          source.event,
          queued ? none : row.predicted,
          std::span(states_).subspan(row.states, row.width),
          std::span(states_).subspan(row.states + row.width, row.width),
          row.entry,
          std::span(rests_).subspan(row.first_rest, row.rests),
          queued ? row.predicted : none};
}

std::vector<double> EventLog::times(std::string_view name, std::optional<EventKind> kind) const {
  const std::vector<bool> wanted = called(name);
  std::vector<double> found;
  for (const Row& row : rows_) {
    if (!nth(wanted, row.source)) continue;
    if (kind ? row.kind == *kind : is_firing(row.kind)) found.push_back(row.time);
  }
  return found;
}

std::vector<std::string> EventLog::names() const {
  std::vector<std::string> full;
  for (const EventName& name : names_) full.push_back(name.full());
  return full;
}

EventLog EventLog::emptied() const {
  EventLog log;
  log.names_ = names_;
  return log;
}

void EventLog::append(const EventLog& other, std::size_t i, int source, int jump) {
  Row row = other.rows_[i];
  const double* states = other.states_.data() + row.states;
  const int* rests = other.rests_.data() + row.first_rest;
  row.source = source, row.jump = jump;
  row.states = states_.size(), row.first_rest = rests_.size();
  states_.insert(states_.end(), states, states + 2 * row.width);
  rests_.insert(rests_.end(), rests, rests + row.rests);
  rows_.push_back(row);
}

void EventLog::shorten(std::size_t n) {
  if (n >= rows_.size()) return;
  states_.resize(rows_[n].states);
  rests_.resize(rows_[n].first_rest);
  rows_.resize(n);
}

std::vector<bool> EventLog::called(std::string_view name) const {
  std::vector<bool> whole, own;
  for (const EventName& one : names_) {
    whole.push_back(one.full() == name);
    own.push_back(one.event == name);
  }
  if (std::ranges::find(whole, true) != whole.end()) return whole;
  if (std::ranges::find(own, true) != own.end()) return own;
  std::vector<std::string> known;  // names as short or as long as the requested name
  for (const EventName& one : names_) {
    std::string like = name.find('.') == std::string_view::npos ? one.event : one.full();
    if (std::ranges::find(known, like) == known.end()) known.push_back(std::move(like));
  }
  throw ModelError(text("no event is called '", name, "'", known_names(name, known)));
}

}  // namespace saltus
