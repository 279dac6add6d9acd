// Relation decisions: the truth of a relation after a commit, and how its guard is armed. They are
// functions of values (docs/semantics.md, 3.5).
#pragma once

#include <optional>

#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// The facts about a relation that is read again after a commit.
struct RelationFacts {
  bool opaque = false;  ///< a boolean function: its value is only a sign
  bool truth = false;   ///< until now
  double g = 0.0;       ///< its value
  bool fired = false;   ///< in this instant
  int came_from = 0;    ///< the side it fired from
  bool turned = false;  ///< it was turned by an earlier reading in this instant
  bool wrote = false;   ///< reset maps wrote continuous state in this instant

  /// The side by its crossing if it fired; otherwise by its truth.
  int crossed_to() const { return fired ? -came_from : truth ? 1 : -1; }
};

/// The side of a relation by its value alone (3.5); 0: it keeps its truth. Returns no value if the
/// flow has to decide.
///
///     fired   states written   value                     side
///     yes     no               rounding                  the crossing's
///     yes     yes              smooth                    ask
///     yes     yes              opaque, the crossing's    its value's
///     yes     yes              opaque, otherwise         ask
///     no      yes              zero, turned before       ask
///     no      -                otherwise                 its value's
constexpr std::optional<int> decide_relation(const RelationFacts& relation) {
  if (relation.fired && !relation.wrote) return relation.crossed_to();
  const int side = sign_of(relation.g);
  const bool touched = relation.fired || (relation.turned && relation.g == 0.0);
  if (relation.wrote && touched && (!relation.opaque || side != relation.crossed_to())) return {};
  return side;
}

/// The side of a relation that was read again, `side` by its value, where the flips of other relations
/// may have put it at exactly zero, to stay there. An input on a flat piece at zero, as behind a
/// DeadZone, gives no side for the whole piece: `u > 0` is false there, and `u >= 0` is true. At its own
/// root a relation has the side of its crossing, and a write leaves it its truth. `stays()` is whether
/// the flow leads it to no side.
///
///     value      fired, or states written   truth            stays   then
///     not zero   -                          -                -       side
///     opaque     -                          -                -       side
///     zero       yes                        -                -       side
///     zero       no                         that at zero     -       side
///     zero       no                         the other one    no      side
///     zero       no                         the other one    yes     that at zero
template <class Stays>
int decide_at_zero(const RelationFacts& relation, int side, bool true_at_zero, const Stays& stays) {
  if (relation.g != 0.0 || relation.opaque || relation.fired || relation.wrote) return side;
  if (relation.truth == true_at_zero || !stays()) return side;
  return true_at_zero ? 1 : -1;
}

/// The side of a relation at its zero that the flow decides, and whether its blocks come to rest.
///
///     flow to              set off a reset   left at its zero   leads straight back   side           rests
///     none                 -                 -                  -                     the crossing's no
///     the crossing's side  yes               yes                yes                   the flow's     yes
///     otherwise            -                 -                  -                     the flow's     no
///
/// "Leads straight back" is asked only where the flow leads to the side that set off the reset. A
/// reset that leaves the relation far from its zero has put it on that side: no edge follows, so
/// nothing comes to rest.
struct RelationSide {
  int side = 0;
  bool rests = false;
  bool operator==(const RelationSide&) const = default;
};

template <class LeadsBack>
RelationSide decide_relation_side(int flow_to, int crossed_to, bool set_off, bool at_zero,
                                  const LeadsBack& leads_back) {
  if (flow_to == 0) return {crossed_to, false};
  return {flow_to, flow_to == crossed_to && set_off && at_zero && leads_back()};
}

/// Whether a relation that came to exactly zero from the side `from` does not cross it, because the flow
/// takes it back. It is at zero for no time, so its truth does not change. `flow_to()` is the side to
/// which the flow leads.
///
///     value      flow to          touches
///     not zero   not asked        no
///     zero       where it was     yes
///     zero       otherwise        no
template <class FlowTo>
bool only_touches(double g, int from, const FlowTo& flow_to) {
  return g == 0.0 && flow_to() == from;
}

/// Decides how a relation is armed when integration continues.
///
///     opaque                                       as its truth, phase unchanged
///     clearly on its side, not fired               unchanged
///     frozen: it keeps its truth on a hold         waits within its value
///     otherwise                                    waits within the flow's error; fires at once
///                                                  where the flow takes it to the other side
enum class RelationArming { by_truth, unchanged, within_value, by_flow };

constexpr RelationArming decide_relation_arming(bool opaque, int sign, int side, bool fired,
                                                bool frozen) {
  if (opaque) return RelationArming::by_truth;
  if (sign == side && !fired) return RelationArming::unchanged;
  return frozen ? RelationArming::within_value : RelationArming::by_flow;
}

}  // namespace saltus
