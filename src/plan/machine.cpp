// Machine: construction, loading and saving a context.
#include "saltus/plan/detail/machine.hpp"

#include "saltus/plan/detail/flatten.hpp"

namespace saltus {

namespace {

/// Derivative of a leaf without an ode, whose states only reset maps change: zero.
const VectorFunction& still() {
  static const VectorFunction zero([](const At&, VectorRef xdot) { xdot.setZero(); });
  return zero;
}

}  // namespace

std::vector<Machine::OutputCall> Machine::calls_of(const std::vector<int>& nodes) {
  std::vector<OutputCall> calls;
  for (int i : nodes) {
    const Node& node = plan_->node(i);
    const VectorFunction& function =
        node.relation ? plan_->relation_of(node).guard : plan_->output_of(node).calc;
    calls.push_back({call_of(function, static_cast<std::size_t>(node.leaf)), node.place.offset,
                     node.place.size, node.relation,
                     node.relation && plan_->relation_of(node).true_at_zero});
  }
  return calls;
}

/// The calls of a walk, with its fused formulas.
std::vector<Machine::OutputCall> Machine::calls_of(const Walk& walk,
                                                   const std::vector<int>& nodes) {
  if (!walk.fuses()) return calls_of(nodes);
  std::vector<OutputCall> calls;
  for (const Walk::Stage& stage : walk.stages) {
    if (stage.fused) calls.push_back({whole_call(stage.fused), 0, plan_->ny, false, false});
    for (const OutputCall& call : calls_of(stage.calls)) calls.push_back(call);
  }
  return calls;
}

std::vector<Machine::Call> Machine::odes_of(const Walk& walk) {
  std::vector<Call> odes;
  if (walk.last) odes.push_back(whole_call(walk.last));
  for (std::size_t i = 0; i < plan_->odes.size(); ++i) {
    if (walk.fuses() && walk.fused[i]) continue;
    const auto leaf = static_cast<std::size_t>(plan_->odes[i]);
    const VectorFunction& ode = plan_->leaves[leaf].declared().continuous.ode.function;
    odes.push_back(call_of(ode ? ode : still(), leaf));
  }
  return odes;
}

/// A call of a function over the whole machine. A tape needs no leaf and no mode, so any leaf will
/// do.
Machine::Call Machine::whole_call(const VectorFunction& fused) {
  return {&fused, plan_->leaves.front().system, 0, &views_.back(), 0, plan_->nx};
}

Machine::Machine(std::shared_ptr<const Plan> plan) : plan_(std::move(plan)) {
  x.setZero(plan_->nx), z.setZero(plan_->nz), p.setZero(plan_->np), y.setZero(plan_->ny);
  modes.assign(plan_->leaves.size(), 0);
  rests_.assign(static_cast<std::size_t>(plan_->nx), 0);
  resting_of_.assign(plan_->leaves.size(), 0);
  for (std::size_t i = 0; i < plan_->leaves.size(); ++i)
    leaf_of_state_.insert(leaf_of_state_.end(), static_cast<std::size_t>(plan_->leaves[i].nx), i);
  bases_ = {x.data(), z.data(), p.data(), y.data()};
  for (const PlanLeaf& leaf : plan_->leaves) {
    for (int node : leaf.relations) relation_values_.push_back(signal(node));
  }
  const double* const* relations = relation_values_.data();
  for (const PlanLeaf& leaf : plan_->leaves) {
    const Inputs inputs(leaf.input_places.data(), static_cast<int>(leaf.input_places.size()),
                        &bases_);
    views_.push_back(At(0.0, {x.data() + leaf.x, leaf.nx}, {z.data() + leaf.z, leaf.nz},
                        {p.data() + leaf.p, leaf.np}, 0, inputs, relations));
    relations += leaf.relations.size();
  }
  place_of_z_ = {Space::z, 0, plan_->nz};
  views_.push_back(At(0.0, {x.data(), plan_->nx}, {y.data(), plan_->ny}, {p.data(), plan_->np}, 0,
                      Inputs(&place_of_z_, 1, &bases_), nullptr));  // see fuse.hpp
  constant_calls_ = calls_of(plan_->constants);
  instant_calls_ = calls_of(plan_->instants);
  std::vector<int> moving;
  std::ranges::copy_if(plan_->instants, std::back_inserter(moving),
                       [&](int i) { return plan_->node(i).rate == Rate::continuous; });
  moving_calls_ = calls_of(moving);
  needs_of_derivatives_ = calls_of(plan_->derivatives);
  derivative_calls_ = calls_of(plan_->derivative_walk, plan_->derivatives);
  guard_calls_list_ = calls_of(plan_->guard_walk, plan_->guard_needs);
  tap_calls_ = calls_of(plan_->tap_needs);
  odes_ = odes_of(plan_->derivative_walk);
  for (const GuardGroup& group : plan_->guards) {
    const PlanLeaf& leaf = plan_->leaves[static_cast<std::size_t>(group.leaf)];
    const bool crossing = group.kind == GuardGroup::Kind::crossing;
    const VectorFunction& function =
        crossing ? leaf.declared().zero_crossings[static_cast<std::size_t>(group.index)].guard
        : group.kind == GuardGroup::Kind::relation
            ? plan_->relation_of(plan_->node(group.index)).guard
            : plan_->output_of(plan_->node(group.index)).calc;
    groups_.push_back({call_of(function, static_cast<std::size_t>(group.leaf)), group.slot,
                       group.size, group.kind == GuardGroup::Kind::opaque});
  }
  if (plan_->guard_walk.last)
    fused_guards_ = {whole_call(plan_->guard_walk.last), 0, plan_->guard_slots, false};
  if (odes_.size() == 1 && derivative_calls_.empty() && plan_->nx == odes_.front().size)
    lone_ode_ = &odes_.front();
  if (lone_ode_ != nullptr && !reads_states(lone_ode_->leaf)) {
    const RightHandSide& ode = plan_->leaves[lone_ode_->leaf].declared().continuous.ode;
    if (ode.steps != nullptr && lone_ode_->function == &ode.function) inlined_ = &ode;
  }
  select_guards();
}

/// Whether the leaf reads a continuous state through an input.
bool Machine::reads_states(std::size_t leaf) const {
  return std::ranges::any_of(plan_->leaves[leaf].input_places,
                             [](const Place& place) { return place.space == Space::x; });
}

void Machine::load(const Context& context) {
  if (context.continuous_state().size() != plan_->nx ||
      context.discrete_state().size() != plan_->nz || context.parameters().size() != plan_->np ||
      context.modes().size() != plan_->leaves.size()) {
    throw ModelError(text("the context is not one of this system: expected ", plan_->nx,
                          " continuous and ", plan_->nz, " discrete states and ", plan_->np,
                          " parameters, found ", context.continuous_state().size(), ", ",
                          context.discrete_state().size(), " and ", context.parameters().size()));
  }
  x = context.continuous_state();
  z = context.discrete_state();
  p = context.parameters();
  modes = context.modes();
  std::ranges::fill(rests_, 0), std::ranges::fill(resting_of_, 0), at_rest_ = 0;
  y.setZero();
  carrier_ = nullptr;
  rhs_calls = guard_calls = jacobian_calls = 0;
  run(constant_calls_, context.time(), x.data());
  select_guards();
}

void Machine::carried_derivative(double t, const double* state, double* xdot) {
  if (carrier_ == nullptr) return flow(t, state, xdot);
  const double* x_now = carried(t, state);
  flow(t, x_now, xdot);
  carrier_->rates(t, x_now, xdot);
}

void Machine::carried_guards(double t, const double* state, double* g) {
  const double* x_now = carried(t, state);
  guards_at(t, x_now, g);
  if (carrier_ != nullptr) carrier_->lift(t, x_now, g);
}

void Machine::flow(double t, const double* state, double* xdot) {
  ++rhs_calls;
  run(derivative_calls_, t, state);
  if (at_rest_ > 0) {
    for (const Call& ode : odes_) ode_with_rest(ode, t, xdot);
    return;
  }
  for (const Call& ode : odes_) ode_of(ode, t, xdot);
}

void Machine::guards_at(double t, const double* state, double* g) {
  ++guard_calls;
  run(guard_calls_list_, t, state);
  if (fused_guards_) guard(*fused_guards_, t, g);
  for (int i : called_) guard(groups_[static_cast<std::size_t>(i)], t, g);
}

void Machine::ode_with_rest(const Call& ode, double t, double* xdot) {
  VectorRef out(xdot + ode.x, ode.size);
  if (resting_of_[ode.leaf] == ode.size) {
    out.setZero();
    return;
  }
  ode_of(ode, t, xdot);
  for (Index i = 0; i < ode.size; ++i) {
    if (rests(ode.x + i)) out[i] = 0.0;
  }
}

void Machine::guard(const GuardCall& call, double t, double* g) {
  const VectorRef out(g + call.slot, call.width);
  (*call.function)(*call.system, seen_by(call, t), out);
  if (!call.opaque) return;
  for (double& value : VectorRef(out)) value = value != 0.0 ? 1.0 : -1.0;
}

const double* Machine::carry(double t, const double* state) {
  carried_x_ = VectorView(state, x.size());
  carrier_->carry(t, carried_x_.data());
  return carried_x_.data();
}

Context Machine::save(const Context& like, double t,
                      std::shared_ptr<const Continuation> continuation) const {
  Context context = like;
  context.x_ = x;
  context.z_ = z;
  context.modes_ = modes;
  context.time_ = t;
  context.settled_ = true;
  context.continuation_ = std::move(continuation);
  return context;
}

void Machine::select_guards() {
  active_.clear(), called_.clear();
  for (std::size_t i = 0; i < plan_->guards.size(); ++i) {
    const GuardGroup& group = plan_->guards[i];
    const auto leaf = static_cast<std::size_t>(group.leaf);
    if (group.kind == GuardGroup::Kind::crossing) {
      const auto& crossing =
          plan_->leaves[leaf].declared().zero_crossings[static_cast<std::size_t>(group.index)];
      if (crossing.start_mode && *crossing.start_mode != modes[leaf]) continue;
    }
    active_.push_back(static_cast<int>(i));
    if (!fused_guards_ || !plan_->guard_walk.fused[i]) called_.push_back(static_cast<int>(i));
  }
  const GuardCall* first = fused_guards_     ? &*fused_guards_
                           : called_.empty() ? nullptr
                                             : &groups_[static_cast<std::size_t>(called_.front())];
  const bool lone =
      called_.size() + (fused_guards_ ? 1 : 0) == 1 && guard_calls_list_.empty() && !first->opaque;
  lone_guard_ = lone ? first : nullptr;
}

void Machine::change_rest(Index i, int by) {
  int& count = rests_[static_cast<std::size_t>(i)];
  const bool before = count > 0;
  count += by;
  const std::size_t leaf = leaf_of_state_[static_cast<std::size_t>(i)];
  const Index change = static_cast<Index>(count > 0) - static_cast<Index>(before);
  resting_of_[leaf] += change, at_rest_ += change;
}

}  // namespace saltus
