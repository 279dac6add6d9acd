// The small print of a block.
#include <algorithm>
#include <cmath>

#include "parts.hpp"

namespace saltus::detail {

namespace {

const char* arrow(Direction direction) {
  switch (direction) {
    case Direction::positive_then_non_positive:
      return "↓";
    case Direction::negative_then_non_negative:
      return "↑";
    case Direction::crosses_zero:
      return "↕";
    case Direction::edge_detection:
      return "≠";
    case Direction::none:
      return "off";
  }
  return "";
}

const char* arrow(Edge edge) {
  return edge == Edge::rising ? "↑" : edge == Edge::falling ? "↓" : "↕";
}

std::string counted(Index n, const char* what) { return text(n, " ", what, n == 1 ? "" : "s"); }

std::string words_of_times(const std::vector<double>& times) {
  constexpr std::size_t most = 4;
  std::string out = "at t = ";
  for (std::size_t i = 0; i < std::min(most, times.size()); ++i)
    out += text(i == 0 ? "" : ", ", times[i]);
  return times.empty() ? "never" : out + (times.size() > most ? ", ... s" : " s");
}

std::string words_of_end(const TimeEvent& event) {
  std::string out = std::isfinite(event.end) ? text(" to t = ", event.end, " s") : std::string();
  if (event.count) out += text(", ", *event.count, " at most");
  return out;
}

std::string words_of(const TimeEvent& event) {
  const std::string name = event.name.empty() ? std::string() : event.name + " ";
  if (event.times) return text(name, words_of_times(*event.times), words_of_end(event));
  if (event.next) return name + "at times that follow from its discrete state";
  if (event.inherited) return name + "at each trigger";
  if (std::isinf(event.period)) return text(name, "at t = ", event.offset, " s");
  const std::string from =
      event.offset != 0.0 ? text(" from t = ", event.offset, " s") : std::string();
  return text(name, "every ", event.period, " s", from, words_of_end(event));
}

}  // namespace

std::string words_of(const Execution& execution) {
  if (execution.kind == Execution::Kind::enabled)
    return execution.resets ? "enables, resets" : "enables";
  return text("triggers ", arrow(execution.edge));
}

std::string words_of(const ZeroCrossing& crossing) {
  std::string out = text(crossing.name, " ", arrow(crossing.direction));
  if (crossing.size > 1) out += text(" [", crossing.size, "]");
  if (crossing.reset_map) out += " reset";
  if (crossing.terminal) out += " end of run";
  return out;
}

namespace {

/// "2 states, 1 discrete state, begins in mode 0"; empty if there are none.
std::string states_of(const Declarations& d) {
  std::string states;
  if (const Index n = d.continuous.initial.size(); n > 0) states = counted(n, "state");
  if (const Index n = d.discrete.size(); n > 0)
    states += (states.empty() ? "" : ", ") + counted(n, "discrete state");
  if (d.has_modes) states += text(states.empty() ? "" : ", ", "begins in mode ", d.mode);
  return states;
}

/// "mode 0: hit falling reset → mode 1".
std::string note_of(const ZeroCrossing& crossing) {
  const std::string seen =
      crossing.start_mode ? text("mode ", *crossing.start_mode, ": ") : std::string();
  const std::string goes = crossing.end_mode ? text(" → mode ", *crossing.end_mode) : std::string();
  return seen + detail::words_of(crossing) + goes;
}

}  // namespace

std::vector<std::string> notes_of(const LeafSystem& leaf, const Plan* plan, int number) {
  const Declarations& d = leaf.declarations();
  std::vector<std::string> notes;
  if (std::string states = states_of(d); !states.empty()) notes.push_back(std::move(states));
  for (const ZeroCrossing& crossing : d.zero_crossings) notes.push_back(note_of(crossing));
  for (const TimeEvent& event : d.time_events) notes.push_back(words_of(event));
  for (const OutputDeclaration& output : d.outputs) {
    if (!output.sampler) continue;
    for (const TimeEvent& event : output.sampler->declarations().time_events)
      notes.push_back(text(output.name, ".", words_of(event)));
  }
  if (plan == nullptr) return notes;
  for (const GuardGroup& guard : plan->guards) {
    if (guard.leaf == number && guard.is_opaque()) notes.emplace_back("located by bisection");
  }
  return notes;
}

}  // namespace saltus::detail
