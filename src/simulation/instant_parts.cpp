// The memory of an instant: it is made once, cleared for each run, and saved and loaded between
// runs.
#include "saltus/simulation/detail/instant_parts.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

InstantParts::InstantParts(Machine& of, GuardSet& all, const SimulatorOptions& options,
                           Results& results)
    : machine(of),
      guards(all),
      scope(of.plan()),
      present(all.g.size()),
      transition(of),
      journal(of, transition, options, results),
      flow(of, options),
      edges(of),
      holds(of, all, options, flow, transition, journal, present),
      contacts(scope, of, all, options, flow, edges, holds, transition, present),
      relations(scope, of, all, options, flow, edges, holds, contacts, transition, journal,
                present),
      crossings(of, all, flow, holds, contacts, transition, present),
      queues(of, options, transition, journal, present),
      sides(scope, of, all, flow, holds, contacts, relations, crossings, present) {
  guards.scan_points = options.event_scan_points;
}

void InstantParts::begin(double t) {
  jump = 0;
  present.open(t, 0.0);
  std::ranges::fill(present.g, 1.0);  // guards that are inactive now have no value yet
  transition.open();
  journal.begin();
  flow.open(t, 0.0);
  holds.begin();
  contacts.begin();
  guards.clear();
  sides.select();
  do relations.begin(t);
  while (sides.follow_controls());
  sides.see_first();
  edges.begin();
}

bool InstantParts::fits(const Continuation& from) const {
  return relations.fits(from) && from.guards.size() == guards.all().size() && holds.fits(from) &&
         edges.fits(from) && journal.fits(from);
}

void InstantParts::load(double t, const Continuation& from, double longest) {
  jump = from.jump;
  present.open(t, longest);
  flow.open(t, longest);
  relations.load(from);
  holds.load(from);
  edges.load(from);
  journal.load(from);
  machine.evaluate_instant(t);
  sides.follow_controls();
  if (!machine.plan().guards.empty()) machine.guards(t, machine.x.data(), present.g.data());
  load_records(guards, from.guards);
  load_leaving(guards, from.leaving);
  guards.g = present.g;
  contacts.load(from.contacts);
}

Continuation InstantParts::save() const {
  return {.jump = jump,
          .relations = relations.save(),
          .guards = records_of(guards),
          .firings = holds.save(),
          .edges = edges.save(),
          .contacts = contacts.save(),
          .leaving = leaving_of(guards),
          .counts = journal.save()};
}

void InstantParts::open(double t, double longest) {
  present.open(t, longest);
  if (machine.plan().reads_before) machine.evaluate_moving(t, machine.x.data());
  transition.open();
  journal.open(t);
  flow.open(t, longest);
  edges.open();
  holds.open();
  queues.open();
  std::swap(present.firings, guards.fired_at_root);
  guards.fired_at_root.clear();
  guards_before_ = guards.all(), roots_ = present.firings, jump_before_ = jump;
}

void InstantParts::undo() {
  guards.restore(guards_before_);
  guards.arm_again(roots_);
  holds.undo();
  edges.undo();
  queues.undo();
  journal.undo();
  transition.undo();
  jump = jump_before_;
}

}  // namespace saltus
