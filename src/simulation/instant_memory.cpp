// The memory of an instant: it is made once, cleared for each run, and saved and loaded between
// runs.
#include "saltus/simulation/detail/instant.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

Instant::Instant(Machine& machine, GuardSet& guards, const SimulatorOptions& options,
                 Results& results)
    : machine_(&machine),
      guards_(&guards),
      options_(&options),
      scope_(machine.plan()),
      present_(guards.g.size()),
      rows_(scope_, machine, guards, present_),
      transition_(machine),
      journal_(machine, transition_, options, results),
      flow_(machine, options),
      edges_(machine),
      holds_(machine, guards, options, flow_, transition_, journal_, present_),
      contacts_(scope_, machine, guards, options, flow_, edges_, holds_, transition_, present_),
      relations_(scope_, machine, guards, options, flow_, edges_, holds_, contacts_, transition_,
                 journal_, present_),
      crossings_(machine, guards, flow_, holds_, contacts_, transition_, present_),
      executions_(machine, options, transition_, journal_, present_),
      deliveries_(machine, transition_, present_),
      collector_(scope_, plan(), guards, edges_, holds_, contacts_, relations_, crossings_,
                 transition_, journal_, present_),
      effects_(plan(), guards, edges_, holds_, contacts_, executions_, deliveries_, transition_,
               journal_, present_) {
  guards.scan_points = options.event_scan_points;
}

void Instant::begin(double t, Recorder* recorder) {
  jump_ = 0, rows_.begin(recorder);
  present_.open(t, 0.0);
  std::ranges::fill(present_.g, 1.0);  // guards that are inactive now have no value yet
  transition_.open();
  journal_.begin();
  flow_.open(t, 0.0);
  holds_.begin();
  contacts_.begin();
  guards_->clear();
  select_guards();
  do relations_.begin(t);
  while (follow_controls());
  look_at_guards();
  edges_.begin();
}

/// Looks at the first values. A zero crossing off zero is on its side.
void Instant::look_at_guards() {
  for (const std::size_t k : scope_.crossings) guards_->see(k, present_.g[k]);
  for (const std::size_t k : scope_.relations) guards_->g[k] = present_.g[k];
}

void Instant::select_guards() {
  machine_->select_guards();
  guards_->select(machine_->seen_guards().groups(), plan());
  for (const std::size_t k : guards_->active().all)
    if (!(*guards_)[k].was_active) present_.enters(k);
}

Continuation Instant::save() const {
  return {.jump = jump_,
          .relations = relations_.save(),
          .guards = records_of(*guards_),
          .firings = holds_.save(),
          .edges = edges_.save(),
          .contacts = contacts_.save(),
          .leaving = leaving_of(*guards_),
          .counts = journal_.save()};
}

bool Instant::fits(const Continuation& from) const {
  return relations_.fits(from) && from.guards.size() == guards_->all().size() &&
         holds_.fits(from) && edges_.fits(from) && journal_.fits(from);
}

void Instant::resume(double t, Recorder* recorder, const Continuation& from, double longest) {
  begin(t, recorder);
  jump_ = from.jump;
  present_.open(t, longest);
  flow_.open(t, longest);
  relations_.load(from);
  holds_.load(from);
  edges_.load(from);
  journal_.load(from);
  machine_->evaluate_instant(t);
  follow_controls();
  if (!plan().guards.empty()) machine_->guards(t, machine_->x.data(), present_.g.data());
  load_records(*guards_, from.guards);
  load_leaving(*guards_, from.leaving);
  guards_->g = present_.g;
  contacts_.load(from.contacts);
}

void Instant::undo() {
  guards_->restore(before_.guards);
  guards_->arm_again(before_.roots);
  holds_.undo();
  edges_.undo();
  if (executions_.any()) executions_.undo();
  if (deliveries_.any()) deliveries_.undo();
  find_next_due();
  journal_.undo();
  transition_.undo();
  jump_ = before_.jump;
}

bool Instant::finds_roots() {
  guards_->fired_at_root = std::exchange(present_.firings, {});  // of contacts, see load
  for (const std::size_t k : guards_->active().all) {
    const Guard& guard = (*guards_)[k];
    if (guard.monitor || guard.phase != Phase::armed || !guard.crossed(guards_->g[k])) continue;
    guards_->fired_at_root.push_back({static_cast<int>(k), guard.side, false});
  }
  return !guards_->fired_at_root.empty();
}

bool Instant::judges(const MonitorHit& hit, double t, const std::vector<Firing>& roots) const {
  const auto is_relation = [this](const Firing& firing) { return !collector_.is_crossing(firing); };
  return hit.t == t && hit.firing.jump > 0.0 && std::ranges::any_of(roots, is_relation);
}

void Instant::log_monitor(const MonitorHit& hit, const double* x) {
  journal_.note_monitor(hit, (*guards_)[hit.firing.slot], jump_, x);
}

}  // namespace saltus
