// The passes of an instant.
#include <algorithm>
#include <new>
#include <tuple>

#include "saltus/simulation/detail/instant.hpp"

namespace saltus {

/// What stands before the first pass.
void Instant::open(double t, const std::vector<int>& due) {
  t_ = t;
  ++watch_->version;
  outcome_ = {};
  std::ranges::fill(now_, SlotNow{}), std::ranges::fill(carried_, 0);
  edges_fired_.clear(), actions_.clear(), chain_.clear();
  wrote_ = wrote_x_ = flowed_ = entered_ = false;
  effects_ = 0;
  firings_ = watch_->fired;
  watch_->fired.clear();
  x_minus_ = x_next_ = machine_->x, z_minus_ = machine_->z, y_before_ = machine_->y;
  for (const Firing& root : firings_) {
    const auto k = static_cast<std::size_t>(root.slot);
    now_[k].g_minus = watch_->g[k];
    if (root.fresh) now_[k].flight = t - armed_at_[k];
  }
  for (int event : due) {
    const ScheduledEvent& scheduled = plan().schedule[static_cast<std::size_t>(event)];
    actions_.push_back({scheduled.leaf, Cause::time, event, -1, 0, false});
  }
}

Instant::Outcome Instant::run(double t, const std::vector<int>& due, double longest,
                              bool at_start) {
  longest_ = longest;
  open(t, due);
  bool armed = !at_start;
  for (pass_ = 0;; ++pass_) {
    if (pass_ >= options_->max_passes) {
      if (wrote_) throw_no_end();
      outcome_.chatters = true;  // relations or modes only: a surface that both sides lead to
      break;
    }
    event_jump_ = jump_ + 1;
    const bool let_go = look_at_firings();
    const bool flipped = flip_relations();
    machine_->evaluate_instant(t);
    const bool released = collect_edges() || let_go;
    add_crossings();
    if (flipped || released || !actions_.empty() || (pass_ == 0 && held_outputs_changed())) {
      run_pass();
      armed = false;
      continue;
    }
    if (armed) break;
    event_jump_ = jump_;
    arm(at_start);
    armed = true;
    if (firings_.empty() && actions_.empty()) break;
  }
  for (int node : plan().restarting) {
    if (changed(plan().node(node).place)) outcome_.restart = true;
  }
  return outcome_;
}

/// Whether what stands there is another value than before the instant.
bool Instant::changed(const Place& place) const {
  if (place.space == Space::p) return false;
  const auto& [before, now] = place.space == Space::x   ? std::tie(x_minus_, machine_->x)
                              : place.space == Space::z ? std::tie(z_minus_, machine_->z)
                                                        : std::tie(y_before_, machine_->y);
  return before.segment(place.offset, place.size) != now.segment(place.offset, place.size);
}

bool Instant::held_outputs_changed() const {
  return std::ranges::any_of(plan().instants, [&](int i) {
    const Node& node = plan().node(i);
    return node.rate == Rate::held && changed(node.place);
  });
}

/// Relations whose root was found take the side the crossing says: the value there may be exactly
/// zero.
bool Instant::flip_relations() {
  bool flipped = false;
  std::ranges::fill(fired_now_, 0);
  for (const Firing& firing : firings_) {
    const auto slot = static_cast<std::size_t>(firing.slot);
    const GuardGroup& group = group_of(slot);
    now_[slot].fired = true, fired_now_[slot] = 1;
    from_[slot] = static_cast<signed char>(firing.from);
    if (group.kind == GuardGroup::Kind::crossing) continue;
    if (++now_[slot].flips == 3) outcome_.flutters = true;
    truth_of(slot) = firing.from < 0 ? 1.0 : 0.0;
    watch_->slots[slot].side = static_cast<signed char>(firing.from < 0 ? 1 : -1);
    log(EventKind::zero_crossing, source_of(Cause::crossing, group_of_slot_[slot]), group.leaf,
        -firing.from);
    flipped = true;
  }
  return flipped;
}

/// The edges of watched signals; true if a falling one ended a hold.
bool Instant::collect_edges() {
  bool released = false;
  for (std::size_t e = 0; e < plan().edges.size(); ++e) {
    const EdgeWatch& edge = plan().edges[e];
    const bool now = machine_->truth(edge.node), before = edge_values_[e] != 0;
    edge_values_[e] = now;
    const auto index = static_cast<int>(e);
    if (edge_rests_[e].monitor.holding) {
      if (!now)
        release(edge_rests_[e]), released = true;
      else
        collect_carried(index);
      continue;
    }
    const Edge wanted = reset_of(edge).edge;
    const bool fires_now =
        now != before && (wanted == Edge::either || (wanted == Edge::rising) == now);
    if (!fires_now) continue;
    actions_.push_back({edge.leaf, Cause::edge, index, -1, now ? -1 : 1, false});
    edges_fired_.push_back(index);
  }
  return released;
}

/// A leaf on hold whose reset value moved while its trigger stayed: a floor that rises carries the
/// ball. Not before the relations have been read again, for a floor that falls moves the reset
/// value too.
void Instant::collect_carried(int index) {
  if (pass_ == 0 || carried_[static_cast<std::size_t>(index)]) return;
  const EdgeWatch& edge = plan().edges[static_cast<std::size_t>(index)];
  for (const int input : edge.reads) {
    const Node& node = plan().node(input);
    if (input != edge.node && node.rate == Rate::held && changed(node.place)) {
      actions_.push_back({edge.leaf, Cause::edge, index, -1, -1, true});
      carried_[static_cast<std::size_t>(index)] = 1;
      return;
    }
  }
}

/// The zero crossings that fire in this pass; leaf by leaf, in declaration order.
void Instant::add_crossings() {
  for (const Firing& firing : firings_) {
    const auto slot = static_cast<std::size_t>(firing.slot);
    const GuardGroup& of = group_of(slot);
    if (of.kind != GuardGroup::Kind::crossing) continue;
    const auto group = static_cast<std::size_t>(group_of_slot_[slot]);
    if (!has_effect(of) && !ends_run(group))  // a monitor, or terminal only later
      log(EventKind::zero_crossing, static_cast<int>(group), of.leaf, -firing.from,
          std::numeric_limits<double>::quiet_NaN(), firing.slot - of.slot);
    else
      actions_.push_back({of.leaf, Cause::crossing, static_cast<int>(group), firing.slot,
                          firing.from, slot_rests_[slot].monitor.holding});
  }
  firings_.clear();
  if (actions_.size() < 2) return;
  // Within a leaf updates come first: they read x- z-, and what they write is not lost to a reset.
  const auto before = [](const Action& a, const Action& b) {
    const auto rank = [](Cause cause) {
      return cause == Cause::time ? -1 : static_cast<int>(cause);
    };
    return a.leaf != b.leaf ? a.leaf < b.leaf : rank(a.cause) < rank(b.cause);
  };
  for (auto a = actions_.begin(); a != actions_.end(); ++a) {  // stable, and allocates nothing
    std::rotate(std::upper_bound(actions_.begin(), a, *a, before), a, a + 1);
  }
}

void Instant::run_pass() {
  wrote_ = false;
  x_next_ = machine_->x, z_next_ = machine_->z, modes_next_ = machine_->modes;
  for (const Action& action : actions_) run_action(action);
  actions_.clear();
  commit();
  read_again();
  find_next();
  ++jump_;
  if (recorder_ != nullptr) recorder_->record(t_, jump_, machine_->x.data());
}

void Instant::run_update(const Action& action) {
  const auto& event = leaf(action.leaf)
                          .declared()
                          .time_events[static_cast<std::size_t>(
                              plan().schedule[static_cast<std::size_t>(action.index)].index)];
  if (event.update) run_reset(action, event.update);
  log(EventKind::time, source_of(action.cause, action.index), action.leaf, 0);
}

void Instant::run_action(const Action& action) {
  if (action.cause == Cause::zeno) {
    modes_next_[static_cast<std::size_t>(action.leaf)] = action.from;
    return;
  }
  const int source = source_of(action.cause, action.index);
  if (chain_.size() < 400) chain_.push_back(source);
  if (action.cause == Cause::time) return run_update(action);
  const auto index = static_cast<std::size_t>(action.index);
  const ZeroCrossing* crossing =
      action.cause == Cause::crossing ? &crossing_of(plan().guards[index]) : nullptr;
  const ResetMap& map = crossing ? crossing->reset_map : reset_of(plan().edges[index]).reset_map;
  Rest& rest = crossing ? slot_rests_[static_cast<std::size_t>(action.slot)] : edge_rests_[index];
  const bool effect = map || (crossing && crossing->end_mode);
  if (effect && !action.carry) rest.monitor.fired(t_);
  bool wrote = map && run_reset(action, map);
  if (crossing && crossing->end_mode)
    modes_next_[static_cast<std::size_t>(action.leaf)] = *crossing->end_mode, wrote = true;
  const bool last = crossing && ends_run(index);
  outcome_.terminal = outcome_.terminal || last;
  log(last ? EventKind::terminal : EventKind::zero_crossing, source, action.leaf, -action.from,
      std::numeric_limits<double>::quiet_NaN(), rest.entry);
  if (wrote && !action.carry) look_for_zeno(action, rest);
}

/// Whether the firings accumulate here; if not, how soon the next one may follow.
void Instant::look_for_zeno(const Action& action, Rest& rest) {
  gathered_.resize(static_cast<Index>(rest.states.size()));
  for (std::size_t i = 0; i < rest.states.size(); ++i)
    gathered_[static_cast<Index>(i)] = x_next_[rest.states[i]];
  if (!rest.monitor.on() || !rest.monitor.accumulates()) {
    rest.monitor.remember(gathered_);
    const double gap = rest.monitor.gap();
    if (std::isfinite(gap))
      outcome_.horizon = std::min(outcome_.horizon, std::max(1.2 * gap, least_time()));
    return;
  }
  rest.monitor.accumulate(gathered_);
  for (std::size_t i = 0; i < rest.states.size(); ++i)
    x_next_[rest.states[i]] = gathered_[static_cast<Index>(i)];
  come_to_rest(rest, rest.monitor.accumulation_time(), true);
  if (action.cause == Cause::edge && rest.monitor.holding)
    rest_relations_of(plan().edges[static_cast<std::size_t>(action.index)]);
}

/// Updates read x- z-. Within one leaf each reset map sees what they and the one before left; of
/// other leaves it sees x-. Returns whether continuous state was written.
bool Instant::run_reset(const Action& action, const ResetMap& map) {
  const PlanLeaf& of = leaf(action.leaf);
  const auto number = static_cast<std::size_t>(action.leaf);
  At at = machine_->at(number, t_);
  if (action.cause == Cause::crossing)
    at.entry = slot_rests_[static_cast<std::size_t>(action.slot)].entry;
  if (action.cause != Cause::time) {
    new (&at.x) VectorView(x_next_.data() + of.x, of.nx);
    new (&at.z) VectorView(z_next_.data() + of.z, of.nz);
    at.mode = modes_next_[number];
  }
  Next next({x_next_.data() + of.x, of.nx}, {z_next_.data() + of.z, of.nz}, modes_next_[number],
            of.path);
  map(*of.system, at, next);
  if (!x_next_.segment(of.x, of.nx).allFinite() || !z_next_.segment(of.z, of.nz).allFinite()) {
    throw SimulationError(text("t = ", t_, " s: '", name_of(source_of(action.cause, action.index)),
                               "' set a state that is not finite (NaN or Inf)"),
                          t_, of.path);
  }
  if (next.wrote_continuous_state()) wrote_x_ = outcome_.restart = true, ++effects_;
  wrote_ = wrote_ || next.wrote_continuous_state() || next.wrote_discrete_state();
  const auto shows_z = [&](int i) {  // a held output that shows it is found by its value, one that
                                     // also reads x or t is not
    return plan().node(i).leaf == action.leaf && !plan().node(i).relation &&
           has(plan().output_of(plan().node(i)).reads, Reads::discrete_state);
  };
  const bool ode_reads_z = of.nx > 0 && has(of.declared().continuous.reads, Reads::discrete_state);
  if (next.wrote_discrete_state() &&
      (ode_reads_z || std::ranges::any_of(plan().derivatives, shows_z)))
    outcome_.restart = true;
  return next.wrote_continuous_state();
}

void Instant::commit() {
  if (holds_ > 0) release_kicked();
  machine_->x = x_next_;
  machine_->z = z_next_;
  if (modes_next_ != machine_->modes) {
    modes_before_ = machine_->modes;
    machine_->modes = modes_next_;
    entered_ = true;
    outcome_.restart = true;
    select_guards();
    if (holds_ > 0) release_unseen();
  }
  flowed_ = false;
}

[[noreturn]] void Instant::throw_no_end() const {
  std::string causes;
  const std::size_t first = chain_.size() > 6 ? chain_.size() - 6 : 0;
  for (std::size_t i = first; i < chain_.size(); ++i)
    causes += text(i == first ? "'" : " -> '", name_of(chain_[i]), "'");
  const std::string last = chain_.empty() ? std::string() : name_of(chain_.back());
  throw SimulationError(text("t = ", t_, " s: this instant does not come to an end: more than ",
                             options_->max_passes, " passes; the events set each other off: ... ",
                             causes, " ...; break the loop, or raise max_passes"),
                        t_, last.substr(0, last.rfind('.')));
}

}  // namespace saltus
