// Machine: its memory, its calls, and the walks over them.
#include "saltus/plan/detail/machine.hpp"

#include <algorithm>
#include <utility>

#include "saltus/model/detail/sound.hpp"
#include "saltus/plan/detail/flatten.hpp"

namespace saltus {

Memory::Memory(std::shared_ptr<const Plan> plan) : plan_(std::move(plan)) {
  x.setZero(plan_->nx), z.setZero(plan_->nz), p.setZero(plan_->np), y.setZero(plan_->ny);
  modes.assign(plan_->leaves.size(), 0);
}

namespace {

/// Whether the leaf reads a continuous state through an input.
bool reads_states(const PlanLeaf& leaf) {
  return std::ranges::any_of(leaf.input_places,
                             [](const Place& place) { return place.space == Space::x; });
}

}  // namespace

Machine::Machine(std::shared_ptr<const Plan> plan)
    : CarriedMemory(std::move(plan)),
      arguments_(*this),
      calls_(*plan_, arguments_.views()),
      looked_(calls_.guard_needs.size(), 0),
      seen_(*this),
      resting_(*plan_) {
  if (calls_.odes.size() == 1 && calls_.derivatives.empty() && plan_->nx == calls_.odes[0].size)
    lone_ode_ = &calls_.odes.front();
  if (lone_ode_ != nullptr && !reads_states(plan_->leaf(lone_ode_->leaf))) {
    const RightHandSide& ode = plan_->leaf(lone_ode_->leaf).declared().continuous.ode;
    if (ode.steps != nullptr && lone_ode_->function == &ode.function)
      inlined_ = {&ode, lone_ode_->system, lone_ode_->at};
  }
  select_guards();
}

namespace {

/// The layout of the contexts of a plan's system.
Layout layout_of(const Plan& plan) {
  Layout layout;
  for (const PlanLeaf& leaf : plan.leaves)
    layout.leaves.push_back(
        {leaf.path, leaf.x, leaf.nx, leaf.z, leaf.nz, leaf.p, leaf.np, leaf.declared().parameters});
  return layout;
}

}  // namespace

/// Compares names too. By sizes alone the mass of one block could be taken for the spring of
/// another.
void require_context_of(const Plan& plan, const Context& context) {
  const std::string other = detail::difference(layout_of(plan), context.layout());
  if (other.empty()) return;
  throw ModelError(text("the context is not one of this system: ", other,
                        "; create it with system.create_context()"));
}

void Memory::take(const Context& context) {
  if (known_ == nullptr || known_ != context.layout_) require_context_of(*plan_, context);
  known_ = context.layout_;
  p = context.parameters();
  if (plan_->computed && !context.layout().computed) plan_->computed->compute(p);
  check_parameters();
  x = context.continuous_state();
  z = context.discrete_state();
  modes = context.modes();
  y.setZero();
}

void Memory::check_parameters() const {
  for (const int number : plan_->checked) {
    const PlanLeaf& leaf = plan_->leaf(number);
    const ParameterValues values({p.data() + leaf.p, leaf.np});
    for (const ParameterCheck& check : leaf.declared().parameter_checks) check(leaf.path, values);
  }
}

void Machine::load(const Context& context) {
  take(context);
  resting_.clear();
  carrier_ = nullptr;
  rhs_calls = guard_calls = jacobian_calls = 0;
  run(calls_.constants, context.time(), x.data());
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

namespace {

void ode_of(const Call& ode, Arguments::OfState seen, double t, double* xdot) {
  const VectorRef out(xdot + ode.x, ode.size);
  (*ode.function)(*ode.system, seen.at(ode, t), out);
}

}  // namespace

void Machine::ode_with_rest(const Call& ode, Seen seen, double t, double* xdot) const {
  VectorRef out(xdot + ode.x, ode.size);
  if (resting_.of_leaf(ode.leaf) == ode.size) {
    out.setZero();
    return;
  }
  ode_of(ode, seen, t, xdot);
  for (Index i = 0; i < ode.size; ++i) {
    if (resting_.rests(ode.x + i)) out[i] = 0.0;
  }
}

void Machine::flow(double t, const double* state, double* xdot) {
  ++rhs_calls;
  const Seen seen = run(calls_.derivatives, t, state);
  if (resting_.any()) {
    for (const Call& ode : calls_.odes) ode_with_rest(ode, seen, t, xdot);
    return;
  }
  for (const Call& ode : calls_.odes) ode_of(ode, seen, t, xdot);
}

namespace {

/// Computes a group of guards into its slots of g. The value of an opaque boolean is only a sign.
void compute(const GuardCall& call, const At& at, double* g) {
  const VectorRef out(g + call.slot, call.width);
  (*call.function)(*call.system, at, out);
  if (!call.opaque) return;
  for (double& value : VectorRef(out)) value = value != 0.0 ? 1.0 : -1.0;
}

}  // namespace

/// Copies the values that are looked at with a group of guards.
void Machine::copy_reads(int group, Seen seen, double* g) const {
  const Values values = seen.values();
  for (const ReadSlot& read : plan_->guards[group].reads) g[read.slot] = *values(read.place);
}

void Machine::guards_at(double t, const double* state, double* g) {
  ++guard_calls;
  const Seen seen = run(calls_.guard_needs, t, state);
  if (calls_.fused_guards) compute(*calls_.fused_guards, seen.at(*calls_.fused_guards, t), g);
  const At* at = nullptr;
  for (const int i : seen_.single()) {
    const GuardCall& call = calls_.guards[i];
    if (call.at != at) at = &seen.at(call, t);  // the guards of one leaf follow each other
    compute(call, *at, g);
  }
  for (const int i : seen_.looked()) copy_reads(i, seen, g);
}

/// What these groups need: a signal that several of them need is computed once.
Machine::Seen Machine::run_needs_of(std::span<const int> groups, double t, const double* state) {
  const auto is_whole = [this](int i) { return calls_.guard_cones[i].whole; };
  if (groups.size() == calls_.guards.size() || std::ranges::any_of(groups, is_whole))
    return run(calls_.guard_needs, t, state);
  const Seen seen = arguments_.of(state);
  ++look_;
  for (const int i : groups) {
    for (const int call : calls_.guard_cones[i].calls)
      if (std::exchange(looked_[call], look_) != look_) run(nth(calls_.guard_needs, call), seen, t);
  }
  return seen;
}

void Machine::guards_of(std::span<const int> groups, double t, const double* state, double* g) {
  if (lone_guard_ != nullptr || carrier_ != nullptr) return guards(t, state, g);
  ++guard_calls;
  const Seen seen = run_needs_of(groups, t, state);
  bool fused = false;
  for (const int i : groups) {
    if (calls_.fused_guards && plan_->walks.guards.fused[i])
      fused = true;
    else
      compute(calls_.guards[i], seen.at(calls_.guards[i], t), g);
  }
  if (fused) compute(*calls_.fused_guards, seen.at(*calls_.fused_guards, t), g);
  for (const int i : groups) copy_reads(i, seen, g);
}

Context Memory::save(const Context& like, double t,
                     std::shared_ptr<const Continuation> continuation, bool settled,
                     std::shared_ptr<const PendingExecutions> pending) const {
  Context context = like;
  context.x_ = x;
  context.z_ = z;
  context.modes_ = modes;
  context.time_ = t;
  context.settled_ = settled;
  context.continuation_ = std::move(continuation);
  context.pending_ = std::move(pending);
  return context;
}

void Machine::select_guards() {
  const auto& fused = calls_.fused_guards;
  seen_.select(fused.has_value());
  const std::vector<int>& single = seen_.single();
  const GuardCall* first = fused ? &*fused : single.empty() ? nullptr : &calls_.guards[single[0]];
  const bool lone =
      single.size() + (fused ? 1 : 0) == 1 && calls_.guard_needs.empty() && !first->opaque;
  lone_guard_ = lone ? first : nullptr;
}

}  // namespace saltus
