// Transition: runs reset maps and updates, and commits their results together.
#include "saltus/simulation/detail/transition.hpp"

#include <algorithm>
#include <new>
#include <tuple>

namespace saltus {

namespace {

/// Copies numbers between vectors of one size, which Eigen's assignment would compare and resize.
void copy(const Eigen::VectorXd& from, Eigen::VectorXd& to) {
  std::copy_n(from.data(), from.size(), to.data());
}

}  // namespace

Transition::Transition(Machine& machine)
    : machine_(&machine),
      x_minus_(machine.x.size()),
      z_minus_(machine.z.size()),
      y_minus_(machine.y.size()),
      x_next_(machine.x.size()),
      z_next_(machine.z.size()) {}

void Transition::open() {
  pass_wrote_ = entered_ = restarts_ = wrote_mode_ = false;
  effects_ = 0;
  copy(machine_->x, x_minus_), copy(machine_->x, x_next_);
  copy(machine_->z, z_minus_), copy(machine_->y, y_minus_);
  modes_next_ = machine_->modes;
}

void Transition::undo() {
  copy(x_minus_, machine_->x), copy(z_minus_, machine_->z), copy(y_minus_, machine_->y);
  if (entered_) machine_->modes = modes_minus_;
}

/// The modes to come are the present ones already, unless the last pass wrote one.
void Transition::begin_pass() {
  copy(machine_->x, x_next_), copy(machine_->z, z_next_);
  if (wrote_mode_) modes_next_ = machine_->modes;
  pass_wrote_ = wrote_mode_ = false;
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
  const bool entered = modes_next_[number] != mode;
  wrote_mode_ = wrote_mode_ || entered;
  return x || z || entered;
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
  copy(x_next_, machine_->x), copy(z_next_, machine_->z);
  if (!wrote_mode_ || modes_next_ == machine_->modes) return false;
  if (!entered_) modes_minus_ = machine_->modes;
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
