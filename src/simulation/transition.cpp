// Transition: runs reset maps and updates, and commits their results together.
#include "saltus/simulation/detail/transition.hpp"

#include <algorithm>
#include <new>
#include <tuple>

namespace saltus {

void Transition::open() {
  pass_wrote_ = entered_ = restarts_ = false;
  effects_ = 0;
  x_minus_ = x_next_ = machine_->x, z_minus_ = machine_->z, y_minus_ = machine_->y;
  modes_minus_ = machine_->modes;
}

void Transition::undo() {
  machine_->x = x_minus_, machine_->z = z_minus_, machine_->y = y_minus_;
  machine_->modes = modes_minus_;
}

void Transition::begin_pass() {
  pass_wrote_ = false;
  x_next_ = machine_->x, z_next_ = machine_->z, modes_next_ = machine_->modes;
}

namespace {

/// Each reset map is followed by this look at all states of its leaf: n impacts at one instant take
/// n squared. The sum takes a sixth of the instructions of `allFinite`.
bool is_finite(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return (0.0 * values).sum() == 0.0;  // zero times Inf or NaN is NaN
}

}  // namespace

bool Transition::run(const Call& call) {
  const int number = call.leaf;
  const PlanLeaf& of = machine_->plan().leaf(number);
  At at = machine_->at(number, call.t, machine_->x.data());
  at.entry = call.entry;
  new (&at.x) VectorView(x_next_.data() + of.x, of.nx);
  new (&at.z) VectorView(z_next_.data() + of.z, of.nz);
  const int mode = at.mode = modes_next_[number];
  Next next({x_next_.data() + of.x, of.nx}, {z_next_.data() + of.z, of.nz}, modes_next_[number],
            of.path);
  (*call.map)(*of.system, at, next);
  if (!is_finite(x_next_.segment(of.x, of.nx)) || !is_finite(z_next_.segment(of.z, of.nz))) {
    throw SimulationError(
        text("t = ", call.t, " s: '", call.source, "' set a state that is not finite (NaN or Inf)"),
        call.t, of.path);
  }
  const bool x = next.wrote_continuous_state(), z = next.wrote_discrete_state();
  pass_wrote_ = pass_wrote_ || x || z;
  effects_ += x;
  restarts_ = restarts_ || x || (z && derivatives_read(Reads::discrete_state, call.leaf));
  return x || z || modes_next_[number] != mode;
}

/// A held output that depends on z only is found by its value. An output that also reads x or t is
/// not.
bool Transition::derivatives_read(Reads kind, int number) const {
  const Plan& plan = machine_->plan();
  const PlanLeaf& of = plan.leaf(number);
  const auto shows = [&](int i) {
    const Node& node = plan.node(i);
    return node.leaf == number && !node.relation && has(plan.output_of(node).reads, kind);
  };
  return (of.nx > 0 && has(of.declared().continuous.reads, kind)) ||
         std::ranges::any_of(plan.derivatives, shows);
}

bool Transition::commit() {
  machine_->x = x_next_;
  machine_->z = z_next_;
  if (modes_next_ == machine_->modes) return false;
  modes_before_ = machine_->modes;
  machine_->modes = modes_next_;
  return entered_ = restarts_ = true;
}

bool Transition::changed(const Place& place) const {
  if (place.space == Space::p) return false;
  const auto& [before, now] = place.space == Space::x   ? std::tie(x_minus_, machine_->x)
                              : place.space == Space::z ? std::tie(z_minus_, machine_->z)
                                                        : std::tie(y_minus_, machine_->y);
  return before.segment(place.offset, place.size) != now.segment(place.offset, place.size);
}

bool Transition::held_outputs_changed() const {
  const Plan& plan = machine_->plan();
  return std::ranges::any_of(plan.instants, [&](int i) {
    return plan.node(i).rate == Rate::held && changed(plan.node(i).place);
  });
}

bool Transition::restarts() const {
  const Plan& plan = machine_->plan();
  return restarts_ || std::ranges::any_of(plan.restarting,
                                          [&](int node) { return changed(plan.node(node).place); });
}

}  // namespace saltus
