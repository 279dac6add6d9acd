// Transition: runs reset maps and updates, and commits their results together.
#include "saltus/simulation/detail/transition.hpp"

#include <algorithm>
#include <new>

#include "saltus/simulation/detail/tangents.hpp"

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
      z_next_(machine.z.size()),
      writes_(machine.plan().leaves.size()) {}

void Transition::open() {
  pass_wrote_ = entered_ = restarts_ = wrote_mode_ = false;
  writes_.clear();
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
  if (tangents_ != nullptr) tangents_->begin_pass();
}

namespace {

/// Each reset map is followed by this look at all states of its leaf: n impacts at one instant take
/// n squared. The sum takes a sixth of the instructions of `allFinite`.
bool is_finite(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return (0.0 * values).sum() == 0.0;  // zero times Inf or NaN is NaN
}

}  // namespace

/// The arguments of a function of a leaf in this pass: its states and its mode are those to come.
At Transition::seen(int leaf, Index entry, double t) {
  const PlanLeaf& of = machine_->plan().leaf(leaf);
  At at = machine_->at(leaf, t, machine_->x.data());
  at.entry = entry;
  new (&at.x) VectorView(x_next_.data() + of.x, of.nx);
  new (&at.z) VectorView(z_next_.data() + of.z, of.nz);
  at.mode = modes_next_[leaf];
  return at;
}

Inputs Transition::inputs_before(int leaf) {
  minus_ = {x_minus_.data(), z_minus_.data(), machine_->p.data(), y_minus_.data()};
  const List<Place>& places = machine_->plan().leaf(leaf).input_places;
  return {places.data(), static_cast<int>(places.size()), &minus_};
}

namespace {

[[noreturn]] void throw_not_finite(double t, std::string_view source, const std::string& path) {
  throw SimulationError(
      text("t = ", t, " s: '", source, "' set a state that is not finite (NaN or Inf)"), t, path);
}

}  // namespace

/// Runs a reset map, which writes to x, z and the mode.
Transition::Wrote Transition::apply(const Call& call, VectorRef x, VectorRef z, int& mode) {
  const PlanLeaf& of = machine_->plan().leaf(call.leaf);
  At at = seen(call.leaf, call.entry, call.t);
  if (call.before) at.u = inputs_before(call.leaf);
  Next next(x, z, mode, of.path);
  (*call.map)(*of.system, at, next);
  if (!is_finite(x) || !is_finite(z)) throw_not_finite(call.t, call.source, of.path);
  return {next.wrote_continuous_state(), next.wrote_discrete_state()};
}

/// The weight is one more input, behind those of the leaf: traced functions read it there.
Transition::Wrote Transition::receive(const Arrival& arrival, VectorRef x, VectorRef z, int& mode) {
  const Plan& plan = machine_->plan();
  const PlanLeaf& of = plan.leaf(arrival.leaf);
  const EventInputDeclaration& input = of.declared().event_inputs[arrival.input];
  machine_->y[plan.event_wires.weight.offset] = arrival.weight;
  now_ = {machine_->x.data(), machine_->z.data(), machine_->p.data(), machine_->y.data()};
  At at = seen(arrival.leaf, arrival.entry, arrival.t);
  at.u = {of.delivery_places.data(), static_cast<int>(of.delivery_places.size()), &now_};
  Delivery next(x, z, mode, of.path, arrival.weight);
  input.reset_map(*of.system, at, next);
  if (!is_finite(x) || !is_finite(z))
    throw_not_finite(arrival.t, text(of.path, ".", input.name), of.path);
  return {next.wrote_continuous_state(), next.wrote_discrete_state()};
}

void Transition::deliver(const Arrival& arrival) {
  const PlanLeaf& of = machine_->plan().leaf(arrival.leaf);
  int& to = modes_next_[arrival.leaf];
  const int mode = to;
  if (tangents_ != nullptr) tangents_->deliver(arrival, seen_by(arrival.leaf, arrival.entry));
  count(arrival.leaf,
        receive(arrival, {x_next_.data() + of.x, of.nx}, {z_next_.data() + of.z, of.nz}, to));
  wrote_mode_ = wrote_mode_ || to != mode;
}

void Transition::count(int leaf, Wrote wrote) {
  pass_wrote_ = pass_wrote_ || wrote.x || wrote.z;
  if (wrote.x) writes_.add(leaf);
  restarts_ = restarts_ || wrote.x ||
              (wrote.z && derivatives_read(machine_->plan(), Reads::discrete_state, leaf));
}

bool Transition::run(const Call& call) {
  const PlanLeaf& of = machine_->plan().leaf(call.leaf);
  int& to = modes_next_[call.leaf];
  const int mode = to;
  if (tangents_ != nullptr) tangents_->call(call, seen_by(call.leaf, call.entry));
  const Wrote wrote =
      apply(call, {x_next_.data() + of.x, of.nx}, {z_next_.data() + of.z, of.nz}, to);
  count(call.leaf, wrote);
  const bool entered = to != mode;
  wrote_mode_ = wrote_mode_ || entered;
  return wrote.x || wrote.z || entered;
}

double Transition::number(const NumberOf& number, int leaf, Index entry, double t) {
  return number(*machine_->plan().leaf(leaf).system, seen(leaf, entry, t));
}

namespace {

/// Lists the entries that differ from those before, with their values.
void list_changes(const VectorView& before, const Eigen::VectorXd& after, std::vector<int>& entries,
                  std::vector<double>& values) {
  for (Index i = 0; i < after.size(); ++i) {
    if (after[i] == before[i]) continue;
    entries.push_back(static_cast<int>(i));
    values.push_back(after[i]);
  }
}

}  // namespace

FrozenValues Transition::values(const Call& call) {
  const PlanLeaf& of = machine_->plan().leaf(call.leaf);
  const VectorView x_now(x_next_.data() + of.x, of.nx), z_now(z_next_.data() + of.z, of.nz);
  Eigen::VectorXd x = x_now, z = z_now;
  int mode = modes_next_[call.leaf];
  const Wrote wrote = apply(call, {x.data(), of.nx}, {z.data(), of.nz}, mode);
  FrozenValues values{.wrote_continuous = wrote.x,
                      .wrote_discrete = wrote.z,
                      .wrote_mode = mode != modes_next_[call.leaf],
                      .mode = mode};
  list_changes(x_now, x, values.continuous_entries, values.continuous);
  list_changes(z_now, z, values.discrete_entries, values.discrete);
  return values;
}

void Transition::write(int leaf, const FrozenValues& values) {
  const PlanLeaf& of = machine_->plan().leaf(leaf);
  for (std::size_t i = 0; i < values.continuous.size(); ++i)
    x_next_[of.x + values.continuous_entries[i]] = values.continuous[i];
  for (std::size_t i = 0; i < values.discrete.size(); ++i)
    z_next_[of.z + values.discrete_entries[i]] = values.discrete[i];
  if (values.wrote_mode) enter_mode(leaf, values.mode);
  count(leaf, {values.wrote_continuous, values.wrote_discrete});
}

bool Transition::commit() {
  if (tangents_ != nullptr) tangents_->commit();
  copy(x_next_, machine_->x), copy(z_next_, machine_->z);
  if (!wrote_mode_ || modes_next_ == machine_->modes) return false;
  if (!entered_) modes_minus_ = machine_->modes;
  modes_before_ = machine_->modes;
  machine_->modes = modes_next_;
  return entered_ = restarts_ = true;
}

void Transition::guards_after(std::span<const int> groups, double t, double* values) {
  const auto swap = [&] {
    std::swap_ranges(z_next_.begin(), z_next_.end(), machine_->z.begin());
    std::swap(machine_->modes, modes_next_);
  };
  struct Back {
    const decltype(swap)& again;
    ~Back() { again(); }
  };
  swap();
  const Back back{swap};
  machine_->guards_of(groups, t, x_next_.data(), values);
}

void Transition::swap_with_before() {
  if (entered_) std::swap(machine_->modes, modes_before_);
  std::swap_ranges(y_minus_.begin(), y_minus_.end(), machine_->y.begin());
}

}  // namespace saltus
