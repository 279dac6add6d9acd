// The passes of an instant.
#include "saltus/simulation/detail/instant.hpp"

#include <utility>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

Instant::Instant(Machine& machine, GuardSet& guards, const SimulatorOptions& options,
                 Results& results)
    : options_(&options),
      parts_(machine, guards, options, results),
      rows_(parts_.scope, machine, guards, parts_.present),
      monitors_(parts_),
      stops_(parts_, monitors_),
      collector_(parts_.scope, machine.plan(), guards, parts_.edges, parts_.holds, parts_.contacts,
                 parts_.relations, parts_.crossings, parts_.transition, parts_.journal,
                 parts_.present),
      effects_(machine.plan(), guards, parts_.edges, parts_.holds, parts_.contacts,
               parts_.queues.executions(), parts_.queues.deliveries(), parts_.transition,
               parts_.journal, parts_.present) {}

void Instant::open(double t, const std::vector<int>& due, double longest) {
  parts_.open(t, longest);
  Present& present = parts_.present;
  for (const Firing& root : present.firings) {
    const std::size_t k = root.guard();
    GuardNow& now = present.note(k);
    if (root.jump > 0.0 && root.jump > parts_.crossings.uncertainty(k)) now.jump = root.jump;
    now.location = location_error(parts_.guards.g[k], now.jumped());
    now.before = parts_.guards.base_before_root(k);
    if (root.at_zero && !now.jumped()) now.flight = t - parts_.guards[k].armed_at;
  }
  parts_.flow.forget();  // it belongs to x-
  const Plan& plan = parts_.machine.plan();
  for (const int event : due)
    present.actions.push_back({plan.scheduled(event).leaf, Cause::time, event, -1, 0, false});
  if (Tangents* tangents = parts_.transition.tangents())
    tangents->open(present, due, parts_.queues.due_now());
}

Outcome Instant::run(double t, const std::vector<int>& due, double longest, bool at_start) {
  open(t, due, longest);
  Present& present = parts_.present;
  bool armed = !at_start;
  parts_.sides.turn_beside_root();
  for (; !is_endless(); ++present.pass) {
    if (collect()) {
      run_pass();
      armed = false;
      continue;
    }
    if (armed && !std::exchange(present.contact_changed, false)) break;
    parts_.journal.at_jump(parts_.jump);
    parts_.sides.arm(at_start);
    if (std::exchange(present.placed, false))
      rows_.again(parts_.jump), parts_.journal.renew_after();
    armed = true;
    if (present.firings.empty() && present.actions.empty()) break;
  }
  return close();
}

/// Whether the passes do not end, where only relations or modes change. An error where states are written.
bool Instant::is_endless() {
  if (parts_.present.pass - parts_.queues.beside() < options_->max_passes) return false;
  if (parts_.transition.pass_wrote() || parts_.queues.acted()) parts_.journal.throw_no_end();
  return parts_.present.outcome.chatters = true;
}

const Outcome& Instant::close() {
  parts_.queues.find_next();
  Outcome& outcome = parts_.present.outcome;
  outcome.restart = outcome.restart || parts_.transition.restarts();
  outcome.events = parts_.journal.events();
  if (Tangents* tangents = parts_.transition.tangents()) tangents->close();
  return outcome;
}

/// Collects the actions of the next pass. False if there is nothing to do.
bool Instant::collect() {
  Present& present = parts_.present;
  parts_.journal.at_jump(parts_.jump + 1);
  const bool let_go = collector_.take_contacts();
  const bool flipped = collector_.flip_relations();
  rows_.before(parts_.jump, flipped);
  parts_.machine.evaluate_instant(present.t);
  parts_.sides.follow_controls();
  if (present.pass == 0) judge_jumps(flipped);
  tell_tangents();
  const bool released = collector_.collect_edges() || let_go;
  collector_.collect_crossings();
  present.changes = flipped || released ||
                    (present.pass == 0 && parts_.transition.held_outputs_changed()) ||
                    collector_.acts();
  parts_.queues.collect();
  if (!present.changes) parts_.journal.at_jump(parts_.jump);
  collector_.note_passive();
  return present.changes || !present.actions.empty();
}

/// Looks again at the guards that jumped at the root, where the relations of the root had not flipped yet.
void Instant::judge_jumps(bool flipped) {
  const bool monitors = monitors_.judges_any();
  if (flipped && (monitors || collector_.some_jumped())) {
    parts_.machine.guards_at(parts_.present.t, parts_.machine.x.data(), parts_.present.g.data());
    collector_.take_back_jumps();
  }
  if (monitors) monitors_.judge(flipped);
}

void Instant::tell_tangents() {
  Tangents* tangents = parts_.transition.tangents();
  if (tangents == nullptr) return;
  tangents->look_at_firings(parts_.present);
  tangents->evaluated();
}

void Instant::run_pass() {
  parts_.transition.begin_pass();
  for (const Action& action : parts_.present.actions) effects_.run(action);
  parts_.present.actions.clear();
  parts_.queues.deliver();
  commit();
  do parts_.relations.read_again();
  while (parts_.sides.follow_controls());
  parts_.sides.find_next();
  if (parts_.present.changes) rows_.after(++parts_.jump);
}

void Instant::commit() {
  ContactGuards& contacts = parts_.contacts;
  if (parts_.holds.any()) contacts.release_kicked();
  const bool entered = parts_.transition.commit();
  if (entered) parts_.sides.select();
  if (entered && parts_.holds.any()) contacts.release_unseen(ContactGuards::Unseen::by_mode);
  parts_.flow.forget();
}

}  // namespace saltus
