// LinearLimits: guards at zero, relations at their roots, kinks and blocks at rest.
#include "linear_limits.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

namespace {

/// [of the sum of two derivatives, and of the largest one] Sides that differ by less are the same:
/// central differences have an error of 1e-10.
constexpr double same_sides = 1e-8, same_size = 1e-12;

bool same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.size() == 0) return true;
  const double most = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  const Eigen::ArrayXXd allowed =
      same_sides * (a.cwiseAbs() + b.cwiseAbs()).array() + same_size * most;
  return ((a - b).array().abs() <= allowed).all();
}

bool same(const Linearization& a, const Linearization& b) {
  return same(a.A, b.A) && same(a.B, b.B) && same(a.C, b.C) && same(a.D, b.D) &&
         same(a.xdot, b.xdot) && same(a.y, b.y);
}

}  // namespace

void LinearLimits::refuse(const std::string& what) const {
  throw ModelError(text("linearize: t = ", at_.time(), " s: ", what));
}

void LinearLimits::require_motion() const {
  const Machine& machine = at_.machine();
  for (const PlanLeaf& leaf : plan().leaves) {
    for (Index i = 0; i < leaf.nx; ++i) {
      if (!machine.resting().rests(leaf.x + i)) continue;
      refuse(text("block '", leaf.path,
                  "' is at rest: a push to one side releases it, so there is no linearisation; "
                  "expected a state in motion; linearise before the block comes to rest"));
    }
  }
}

void LinearLimits::require_smooth() const {
  if (rule_.obstacle().empty()) return;
  refuse(text(rule_.obstacle(),
              " at this state; expected a state where the derivative exists; "
              "move the state, or ask for the present side with one_sided"));
}

/// The error of a guard by the rounding of the values that move it, and by the location in time.
double LinearLimits::error_of(const ChainRule::Level& level, Index i) const {
  const Eigen::RowVectorXd by = level.by.row(i).leftCols(plan().nx);
  const double terms = by.cwiseAbs().dot(at_.machine().x.cwiseAbs());
  const double speed = std::abs(by.dot(rule_.rates()));
  return thresholds::state_roundings * thresholds::eps * terms +
         thresholds::time_roundings * thresholds::eps * std::abs(at_.time()) * speed;
}

void LinearLimits::require_guards_off_zero() const {
  for (const GuardGroup& group : plan().guards) {
    if (!group.is_crossing() || !plan().crossing_of(group).has_effect()) continue;
    if (group.direction == Direction::edge_detection) continue;
    if (!is_seen(group, at_.machine())) continue;
    require_off_zero(group);
  }
  for (const EdgeWatch& edge : plan().edges) {
    for (const int node : edge.relations) {
      for (Index i = 0; i < plan().node(node).place.size; ++i)
        if (at_root(node, i))
          refuse(text("relation '", plan().name_of(plan().node(node)),
                      "' is at its root, and its "
                      "edge sets off '",
                      edge.name,
                      "', so the flow differs on its two sides; "
                      "expected a state off the root; move the state"));
    }
  }
}

void LinearLimits::require_off_zero(const GuardGroup& group) const {
  const ChainRule::Level level = rule_.level(function_of_guard(plan(), group));
  for (Index i = 0; i < group.size; ++i) {
    const Guard& guard = at_.guards()[group.slot + i];
    double error = error_of(level, i);
    if (!std::isfinite(error)) error = 0.0;
    if (guard.at_zero()) error = std::max(error, guard.error);
    const bool moves = !level.by.row(i).isZero(0.0) || guard.at_zero();
    if (!moves || !(std::abs(level.value[i]) <= error)) continue;
    refuse(text("guard '", group.name, "' has an effect and is at zero (g = ", level.value[i],
                ", error ", error,
                "), so the flow differs on its two sides; expected a state off the guard; move the "
                "state, or linearise a little later"));
  }
}

bool LinearLimits::at_root(int number, Index entry) const {
  const Node& node = plan().node(number);
  if (node.opaque()) return rule_.jumps_here(number);
  const ChainRule::Level level = rule_.relation(number);
  if (level.by.row(entry).isZero(0.0)) return false;
  double error = error_of(level, entry);
  if (!std::isfinite(error)) error = 0.0;
  for (const GuardGroup& group : plan().guards) {
    if (group.is_crossing() || group.index != number) continue;
    const Guard& guard = at_.guards()[group.slot + entry];
    if (guard.at_zero()) error = std::max(error, guard.error);
  }
  return std::abs(level.value[entry]) <= error;
}

void LinearLimits::require_relations_off_roots(const std::function<Linearization()>& matrices,
                                               const Linearization& found) const {
  std::vector<ChainRule::Forced> open;
  for (const int node : rule_.truths()) {
    for (Index i = 0; i < plan().node(node).place.size; ++i)
      if (at_root(node, i)) open.push_back({node, i});
  }
  for (const ChainRule::Forced& one : open) {
    Machine& machine = at_.machine();
    const Eigen::VectorXd y = machine.y;
    rule_.at(at_.time(), one);
    const bool kink = !same(matrices(), found);
    machine.y = y;
    rule_.at(at_.time(), {});
    if (kink)
      refuse(text("relation '", plan().name_of(plan().node(one.node)),
                  "' is at its root, and the derivatives of its two sides differ (a kink); "
                  "expected a state off the kink; move the state, or ask for the present side with "
                  "one_sided"));
  }
}

void LinearLimits::require_finite(const Linearization& found) const {
  const auto check = [&](const Eigen::MatrixXd& matrix, const char* name,
                         const std::vector<std::string>& rows,
                         const std::vector<std::string>& columns) {
    for (Index i = 0; i < matrix.rows(); ++i) {
      for (Index j = 0; j < matrix.cols(); ++j) {
        if (std::isfinite(matrix(i, j))) continue;
        refuse(text("entry of ", name, " by '", nth(columns, j), "' in the row of '", nth(rows, i),
                    "' is ", matrix(i, j),
                    rule_.obstacle().empty() ? std::string() : text(": ", rule_.obstacle()),
                    "; expected a finite derivative; move the state"));
      }
    }
  };
  check(found.A, "A", found.states, found.states), check(found.B, "B", found.states, found.inputs);
  check(found.C, "C", found.outputs, found.states),
      check(found.D, "D", found.outputs, found.inputs);
}

}  // namespace saltus
