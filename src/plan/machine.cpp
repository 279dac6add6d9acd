// Machine: construction, loading and saving a context, and the search for what is not
// finite.
#include "saltus/plan/machine.hpp"

#include "saltus/plan/flatten.hpp"

namespace saltus {

std::vector<Machine::Call> Machine::calls_of(const std::vector<int>& nodes) const {
  std::vector<Call> calls;
  for (int i : nodes) {
    const Node& node = plan_->node(i);
    const VectorFunction& function =
        node.relation ? plan_->relation_of(node).guard : plan_->output_of(node).calc;
    calls.push_back({&function, plan_->leaf_of(node).system, static_cast<std::size_t>(node.leaf),
                     node.place.offset, node.place.size, node.relation,
                     node.relation && plan_->relation_of(node).true_at_zero});
  }
  return calls;
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
    x_offsets_.push_back(leaf.x);
    relations += leaf.relations.size();
  }
  constant_calls_ = calls_of(plan_->constants);
  instant_calls_ = calls_of(plan_->instants);
  std::vector<int> moving;
  std::ranges::copy_if(plan_->instants, std::back_inserter(moving),
                       [&](int i) { return plan_->node(i).rate == Rate::continuous; });
  moving_calls_ = calls_of(moving);
  derivative_calls_ = calls_of(plan_->derivatives);
  guard_calls_list_ = calls_of(plan_->guard_needs);
  tap_calls_ = calls_of(plan_->tap_needs);
  for (int leaf : plan_->odes) {
    const PlanLeaf& of = plan_->leaves[static_cast<std::size_t>(leaf)];
    odes_.push_back({&of.declared().continuous.ode, of.system, static_cast<std::size_t>(leaf)});
  }
  for (const GuardGroup& group : plan_->guards) {
    const PlanLeaf& leaf = plan_->leaves[static_cast<std::size_t>(group.leaf)];
    const bool crossing = group.kind == GuardGroup::Kind::crossing;
    const VectorFunction& function =
        crossing ? leaf.declared().zero_crossings[static_cast<std::size_t>(group.index)].guard
        : group.kind == GuardGroup::Kind::relation
            ? plan_->relation_of(plan_->node(group.index)).guard
            : plan_->output_of(plan_->node(group.index)).calc;
    groups_.push_back({&function, leaf.system, static_cast<std::size_t>(group.leaf), group.slot,
                       group.size, group.kind == GuardGroup::Kind::opaque});
  }
  select_guards();
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
  std::ranges::fill(rests_, 0), std::ranges::fill(resting_of_, 0);
  y.setZero();
  carrier = nullptr;
  rhs_calls = guard_calls = jacobian_calls = 0;
  at_home();
  run(constant_calls_, context.time());
  select_guards();
}

const double* Machine::carry(double t, const double* state) {
  carried_x_ = VectorView(state, x.size());
  carrier->carry(t, carried_x_.data());
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
  active_.clear();
  for (std::size_t i = 0; i < plan_->guards.size(); ++i) {
    const GuardGroup& group = plan_->guards[i];
    const auto leaf = static_cast<std::size_t>(group.leaf);
    if (group.kind == GuardGroup::Kind::crossing) {
      const auto& crossing =
          plan_->leaves[leaf].declared().zero_crossings[static_cast<std::size_t>(group.index)];
      if (crossing.start_mode && *crossing.start_mode != modes[leaf]) continue;
    }
    active_.push_back(static_cast<int>(i));
  }
}

void Machine::change_rest(Index i, int by) {
  int& count = rests_[static_cast<std::size_t>(i)];
  const bool before = count > 0;
  count += by;
  const std::size_t leaf = leaf_of_state_[static_cast<std::size_t>(i)];
  resting_of_[leaf] += static_cast<Index>(count > 0) - static_cast<Index>(before);
}

std::string Machine::not_finite(double t, const double* state) {
  bases_[0] = carried(t, state);
  for (const Call& call : derivative_calls_) {
    const VectorRef out(y.data() + call.offset, call.size);
    (*call.function)(*call.system, view(call.leaf, t), out);
    if (!out.allFinite()) return plan_->leaves[call.leaf].path;
  }
  Eigen::VectorXd xdot(plan_->nx);
  for (const OdeCall& ode : odes_) {
    ode_of(ode, t, xdot.data());
    if (!xdot.segment(x_offsets_[ode.leaf], views_[ode.leaf].x.size()).allFinite())
      return plan_->leaves[ode.leaf].path;
  }
  return {};
}

}  // namespace saltus
