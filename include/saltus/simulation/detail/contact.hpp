// Contacts: blocks at rest on a surface, and their motion while the surface moves.
#pragma once

#include <algorithm>
#include <ranges>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// The blocks that one guard holds at rest: the leaf of a zero crossing, or the blocks whose resets
/// a relation sets off.
struct SurfaceContact {
  struct Member {
    int leaf;
    const ResetMap* map;
    Index entry;  // in a vector of guards
  };
  int slot = -1;     // its guard
  int pressed = -1;  // sign of the guard where the flow presses on the surface
  bool opaque = false;
  bool carried = false;     // the surface or the force moves: the blocks stay on the surface
  bool has_place = true;    // the reset maps have a fixed point on the surface
  bool lands = false;       // the reset maps leave its place as it is: the surface decides it
  bool pressed_on = false;  // the flow led into the surface when it last led anywhere
  double error = 0.0;       // the guard is at zero within it
  double look_ahead = 0.0;  // [s] see lift
  double earlier_look_ahead = 0.0;  // [s] the longest of the earlier pieces of the run
  std::vector<Member> members = {};
  std::vector<Index> states = {};  // entries of x that rest

  /// The number of its guard in the GuardSet.
  std::size_t guard() const { return static_cast<std::size_t>(slot); }
};

/// The state at rest on a moving surface is the fixed point of the reset maps at that time, x =
/// R(t, x): height and speed of the surface. It is found by Aitken's extrapolation entry by entry
/// (A. C. Aitken, Proc. R. Soc. Edinb. 46 (1926) 289), exact where a reset map is affine, as laws
/// of impact are. The contact ends when the free flow from there leads off the surface.
class Contacts final : public Carrier {
 public:
  Contacts(Machine& machine, const SimulatorOptions& options);

  void clear();
  /// The contact of that guard. Null if nothing rests on it.
  SurfaceContact* on(int slot);
  /// A new contact without members. It replaces any contact of that guard.
  SurfaceContact& add(int slot);
  void add(const SurfaceContact& contact) { add(contact.slot) = contact; }
  void remove(int slot);
  bool empty() const noexcept { return present_.empty(); }
  /// The contacts present, in the order of their making.
  auto all() const {
    return present_ | std::views::transform(
                          [this](int slot) -> const SurfaceContact& { return of_slot_[slot]; });
  }

  /// Moves the contact's entries of x to the fixed point. If there is no fixed point, returns false
  /// and leaves x unchanged. Where a whole range of places is fixed, as by h + |y - h|, the place is
  /// that of the surface.
  bool settle(const SurfaceContact& contact, double t, double* x);
  /// The same if the fixed point is on the surface, as near as x is. Otherwise the blocks stay where
  /// they are.
  bool settle_on_surface(const SurfaceContact& contact, double t, double* x);
  /// Finds out whether the reset maps leave the place of a block close to its surface as it is.
  void find_place(SurfaceContact& contact, double t, const double* x);
  /// The value of its guard.
  double guard(const SurfaceContact& contact, double t, const double* x);
  /// Whether the block is on its surface a look ahead later. The fixed point of its reset maps may be
  /// elsewhere, as where a map halves a state: then it is on a surface that stays where it is.
  bool follows(const SurfaceContact& contact, double t, const double* x);
  /// How far the free flow from x takes the guard off the surface: 8 g(d/2) - g(d), in which the
  /// third order cancels. A negative lift means that the flow presses on the surface. An opaque
  /// boolean has a sign only.
  double lift(const SurfaceContact& contact, double t, const double* x);
  /// Whether the surface moves, or the force that presses on it changes, within `longest` [s].
  bool moves(const SurfaceContact& contact, double t, const double* x, double longest);
  /// Sets look_ahead to the time in which curvature moves the states by far more than their
  /// rounding.
  void choose_look_ahead(SurfaceContact& contact, double t, const double* x, double longest);
  /// Whether the surface under some block moves, so that the machine has to carry the block.
  bool moving() const { return std::ranges::any_of(all(), &SurfaceContact::carried); }

  void carry(double t, double* x) override;
  void rates(double t, const double* x, double* xdot) override;
  void lift(double t, const double* x, double* g) override;

 private:
  void reset(const SurfaceContact& contact, double t, const double* from, double* to);
  double extrapolate(const SurfaceContact& contact, double* x);
  double slope(const SurfaceContact& contact, double t, double* x);
  double rounding_of_guard(const SurfaceContact& contact, double t, double* x);
  void land(const SurfaceContact& contact, double t, double* x);
  void free(const SurfaceContact& contact, bool yes);
  double guard_after(const SurfaceContact& contact, double t, const double* x, double d);

  Machine* machine_;
  Eigen::VectorXd absolute_;      // a state below this size counts as zero
  List<SurfaceContact> of_slot_;  // made once, so that a hold allocates nothing
  std::vector<int> present_;      // slots
  Eigen::VectorXd original_, before_, begun_, once_, twice_, trial_, f_, f1_, slow_, stood_, later_,
      slope_, z_, g_;
};

}  // namespace saltus
