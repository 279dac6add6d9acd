// Contacts on surfaces that move.
#include "saltus/simulation/detail/contact.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/contact_decisions.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

Contacts::Contacts(Machine& machine, const SimulatorOptions& options)
    : machine_(&machine), absolute_(machine.plan().nx) {
  for (Index i = 0; i < absolute_.size(); ++i) absolute_[i] = options.atol[i] / options.rtol[i];
  for (auto* v : {&original_, &before_, &begun_, &once_, &twice_, &trial_, &f_, &f1_, &slow_,
                  &stood_, &later_, &slope_})
    v->setZero(machine.plan().nx);
  z_.setZero(machine.plan().nz);
  g_.setOnes(machine.plan().look_slots);
  of_slot_.resize(machine.plan().look_slots);
  present_.reserve(of_slot_.size());
}

void Contacts::clear() { present_.clear(); }

SurfaceContact* Contacts::on(int slot) {
  if (std::ranges::find(present_, slot) == present_.end()) return nullptr;
  return &of_slot_[slot];
}

SurfaceContact& Contacts::add(int slot) {
  remove(slot);
  present_.push_back(slot);
  SurfaceContact& contact = of_slot_[slot];
  SurfaceContact made{.slot = slot};
  made.members.swap(contact.members), made.states.swap(contact.states);
  made.members.clear(), made.states.clear();
  return contact = std::move(made);
}

void Contacts::remove(int slot) { std::erase(present_, slot); }

/// Applies all reset maps once, each to the same state. Only the states that rest keep the result.
void Contacts::reset(const SurfaceContact& contact, double t, const double* from, double* to) {
  machine_->evaluate_moving(t, from);
  std::copy_n(from, trial_.size(), to);
  trial_ = VectorView(from, trial_.size());
  for (const SurfaceContact::Member& member : contact.members) {
    const PlanLeaf& leaf = machine_->plan().leaves[member.leaf];
    At at = machine_->at(member.leaf, t, from);
    at.entry = member.entry;
    z_.segment(leaf.z, leaf.nz) = at.z;
    int mode = at.mode;
    Next next({trial_.data() + leaf.x, leaf.nx}, {z_.data() + leaf.z, leaf.nz}, mode, leaf.path);
    (*member.map)(*leaf.system, at, next);
  }
  for (const Index i : contact.states) to[i] = trial_[i];
}

/// Writes the fixed point extrapolated from begun_, once_ and twice_ to x. Returns how far the
/// reset still moved, in units of rounding. Two moves that differ by rounding alone have no limit:
/// a reset that adds the same amount each time has no fixed point.
double Contacts::extrapolate(const SurfaceContact& contact, double* x) {
  using namespace thresholds;
  double furthest = 0.0;
  for (const Index i : contact.states) {
    const double first = once_[i] - begun_[i], second = twice_[i] - once_[i];
    const double size = std::max(
        {std::abs(original_[i]), std::abs(begun_[i]), std::abs(once_[i]), std::abs(twice_[i])});
    const double rounding = fixed_point_roundings * eps * size;
    furthest = std::max(furthest, std::abs(first) / (rounding + 1e-300));
    const double limit = begun_[i] - first * (first / (second - first));  // a square may underflow
    const bool told = std::abs(first) > rounding && std::abs(second - first) > 4.0 * eps * size;
    x[i] = told && std::isfinite(limit) ? limit : once_[i];
  }
  return furthest;
}

bool Contacts::settle(const SurfaceContact& contact, double t, double* x) {
  using namespace thresholds;
  begun_ = VectorView(x, begun_.size());
  original_ = begun_;
  for (int round = 0; round < fixed_point_rounds; ++round) {
    reset(contact, t, begun_.data(), once_.data());
    reset(contact, t, once_.data(), twice_.data());
    const double furthest = extrapolate(contact, begun_.data());
    if (!(furthest > 1.0)) {
      std::copy_n(begun_.data(), begun_.size(), x);
      if (contact.lands) land(contact, t, x);
      return begun_.allFinite();
    }
  }
  std::copy_n(original_.data(), original_.size(), x);
  return false;
}

bool Contacts::settle_on_surface(const SurfaceContact& contact, double t, double* x) {
  if (contact.opaque) return settle(contact, t, x);
  before_ = VectorView(x, before_.size());
  const double near = std::max(std::abs(guard(contact, t, x)), contact.error);
  if (!settle(contact, t, x)) return false;
  const double there = std::abs(guard(contact, t, x));
  if (there <= std::max(near, rounding_of_guard(contact, t, x))) return true;
  std::copy_n(before_.data(), before_.size(), x);
  return false;
}

/// The change of the guard by the roundings of a fixed point.
double Contacts::rounding_of_guard(const SurfaceContact& contact, double t, double* x) {
  return thresholds::fixed_point_roundings * thresholds::eps * std::sqrt(slope(contact, t, x));
}

/// The derivatives of the guard by the states that rest, in units of the sizes of these. Returns the
/// square of their norm.
double Contacts::slope(const SurfaceContact& contact, double t, double* x) {
  const double g = guard(contact, t, x), part = std::sqrt(thresholds::eps);
  double sum = 0.0;
  for (const Index i : contact.states) {
    const double there = x[i];
    x[i] += part * (std::abs(there) + absolute_[i]);
    slope_[i] = (guard(contact, t, x) - g) / part;
    x[i] = there;
    sum += slope_[i] * slope_[i];
  }
  return sum;
}

void Contacts::find_place(SurfaceContact& contact, double t, const double* x) {
  contact.lands = false;
  if (contact.opaque) return;
  stood_ = VectorView(x, stood_.size());
  land(contact, t, stood_.data());
  const double square = slope(contact, t, stood_.data());
  if (!(square > 0.0) || !std::isfinite(square)) return;
  begun_ = stood_;
  const double off = -contact.pressed * std::sqrt(thresholds::eps / square);
  for (const Index i : contact.states)
    begun_[i] += off * slope_[i] * (std::abs(stood_[i]) + absolute_[i]);
  reset(contact, t, begun_.data(), once_.data());
  contact.lands = std::ranges::all_of(contact.states, [&](Index i) {
    const double moved = std::abs(begun_[i] - stood_[i]);
    return slope_[i] == 0.0 || std::abs(once_[i] - begun_[i]) <= thresholds::same_place * moved;
  });
}

/// Newton's method on the guard, in the direction of its slope.
void Contacts::land(const SurfaceContact& contact, double t, double* x) {
  for (int round = 0; round < thresholds::landing_rounds; ++round) {
    const double square = slope(contact, t, x), g = guard(contact, t, x);
    if (g == 0.0 || !(square > 0.0) || !std::isfinite(g / square)) return;
    for (const Index i : contact.states)
      x[i] -= g / square * slope_[i] * (std::abs(x[i]) + absolute_[i]);
  }
}

/// Releases or holds the states of a contact.
void Contacts::free(const SurfaceContact& contact, bool yes) {
  for (const Index i : contact.states)
    yes ? machine_->resting().move(i) : machine_->resting().rest(i);
}

double Contacts::guard(const SurfaceContact& contact, double t, const double* x) {
  machine_->guards_at(t, x, g_.data());
  return g_[contact.slot];
}

bool Contacts::follows(const SurfaceContact& contact, double t, const double* x) {
  if (contact.opaque) return true;
  const double later = t + contact.look_ahead, now = guard(contact, t, x);
  machine_->flow(t, x, slow_.data());
  later_ = VectorView(x, slow_.size()) + contact.look_ahead * slow_;
  const double rounding = rounding_of_guard(contact, later, later_.data());
  const double moved = std::abs(guard(contact, later, later_.data()) - now);
  if (contact.has_place) settle(contact, later, later_.data());
  return std::abs(guard(contact, later, later_.data()) - now) <=
         std::max(rounding, contact.has_place ? thresholds::follows_to * moved : 0.0);
}

void Contacts::carry(double t, double* x) {
  for (int sweep = 0; sweep < (present_.size() > 1 ? 2 : 1); ++sweep) {
    for (const SurfaceContact& contact : all()) {
      if (contact.carried && contact.has_place) settle(contact, t, x);
    }
  }
}

void Contacts::rates(double t, const double* x, double* xdot) {
  for (const SurfaceContact& contact : all()) {
    if (!contact.carried || !contact.has_place) continue;
    const double d = contact.look_ahead;
    stood_ = VectorView(x, stood_.size());
    later_ = stood_ + d * VectorView(xdot, stood_.size());
    if (!settle(contact, t + d, later_.data())) continue;
    for (const Index i : contact.states) xdot[i] = (later_[i] - stood_[i]) / d;
  }
}

void Contacts::lift(double t, const double* x, double* g) {
  for (const SurfaceContact& contact : all()) {
    if (contact.carried) g[contact.slot] = guard_of_lift(lift(contact, t, x));
  }
}

}  // namespace saltus
