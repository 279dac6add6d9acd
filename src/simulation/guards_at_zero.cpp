// Guards at zero: beside the cause of an instant, at a firing, and at its end.
#include "saltus/simulation/detail/guards_at_zero.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

namespace {

/// A slope, or a column, of a guard that is smaller than this part of its terms is zero: those of
/// called functions are differences with errors of 1e-10 (see TangentProbe), which terms that cancel
/// amplify.
constexpr double zero_part = 1e-6;
/// A column of a guard that is smaller than this part of its terms is zero: the columns of guards that
/// fire together vanish up to the errors of differences (see TangentProbe).
constexpr double column_rounding = 1e-6;
/// The rounding of a guard's value, in parts of its terms and of their movement in a rounding of time.
constexpr double guard_rounding = 1e3 * thresholds::eps;
/// [of the largest value of a guard in the run] A guard that is farther from zero is not beside an
/// event: its rounding is far below, unless its terms cancel to a billionth.
constexpr double beside_event = 1e-9;

/// Whether a guard that moves from zero with this slope would fire if it came from the other side.
bool fires_along(Direction direction, double slope) {
  return slope < 0.0 ? fires(direction, 1, -1) : fires(direction, -1, 1);
}

/// How the flow leads a guard at zero on.
struct ZeroSlope {
  double terms;  // the size of the terms of its slope
  double slope;
  bool rests() const { return !(std::abs(slope) > zero_part * terms); }
};

ZeroSlope zero_slope_of(const GuardTangent& guard, const Eigen::VectorXd& flow) {
  return {.terms = guard.by_state.cwiseAbs().dot(flow.cwiseAbs()) + std::abs(guard.by_time),
          .slope = guard.by_state.dot(flow) + guard.by_time};
}

/// Whether column k moves a guard at zero. The terms cancel at the guard's own root.
bool moves_guard(const GuardTangent& guard, const ZeroSlope& along, const TangentColumns& columns,
                 Index k) {
  const double all = guard.by_state.cwiseAbs().dot(columns.x.col(k).cwiseAbs()) +
                     along.terms * std::abs(columns.t[k]);
  return std::abs(guard.columns[k]) > zero_part * all;
}

/// Whether the flow takes a crossing on in its firing direction. A relation turns in both directions,
/// and may also rest.
bool goes_on(const GuardGroup& group, Direction direction, const ZeroSlope& along) {
  return !group.is_crossing() || (!along.rests() && fires_along(direction, along.slope));
}

}  // namespace

GuardTangent GuardsAtZero::tangent(double t, std::size_t guard, const TangentColumns& columns) {
  return flow_->guard(t, machine_->x.data(), static_cast<Index>(guard), columns);
}

double GuardsAtZero::rounding_of(const GuardTangent& guard, double t,
                                 const Eigen::VectorXd& flow) const {
  return guard_rounding *
         guard.by_state.cwiseAbs().dot(machine_->x.cwiseAbs() + std::abs(t) * flow.cwiseAbs());
}

// --- beside the event of an instant

/// It would fire at this time too: the order of both is that of their roundings.
std::vector<std::size_t> GuardsAtZero::beside(const Present& present, const TangentColumns& until,
                                              const Eigen::VectorXd& flow, bool caused) {
  std::vector<std::size_t> found;
  if (guards_->active().all.empty()) return found;
  Machine& probe = probe_->at(machine_->x.data());
  Eigen::VectorXd g(machine_->plan().look_slots);
  probe.guards_at(present.t, probe.x.data(), g.data());
  for (const std::size_t k : guards_->active().all) {
    const Guard& guard = (*guards_)[k];
    const auto slot = static_cast<Index>(k);
    sizes_[slot] = std::max(sizes_[slot], std::abs(g[slot]));
    const bool may_fire =
        caused && present.firings.empty() && !guard.monitor && guard.phase == Phase::armed;
    if (may_fire && std::abs(g[slot]) <= beside_event * sizes_[slot] &&
        is_about_to_fire(k, g[slot], present.t, until, flow))
      found.push_back(k);
  }
  return found;
}

bool GuardsAtZero::is_about_to_fire(std::size_t number, double g, double t,
                                    const TangentColumns& until, const Eigen::VectorXd& flow) {
  const Guard& record = (*guards_)[number];
  const GuardGroup& group = machine_->plan().guard(record.group);
  if (!group.is_crossing() || group.is_opaque()) return false;
  const GuardTangent guard = tangent(t, number, until);
  const double slope = zero_slope_of(guard, flow).slope;
  return fires(record.direction, record.side, slope < 0.0 ? -1 : 1) &&
         std::abs(g) <= rounding_of(guard, t, flow);
}

// --- in its passes

/// For a parameter that moves such a guard off zero there is an event on one side only.
void GuardsAtZero::look_at_firings(const Present& present) {
  if (present.pass == 0) return;  // these are roots
  for (const Firing& firing : present.firings) {
    const std::size_t number = firing.guard();
    const GuardGroup& group = machine_->plan().guard((*guards_)[number].group);
    if (!group.is_crossing()) continue;
    const GuardTangent guard = tangent(present.t, number, *columns_);
    const double rounding =
        rounding_of(guard, present.t, probe_->flow(present.t, machine_->x.data()));
    if (std::abs(present.g[number]) > std::max((*guards_)[number].error, rounding)) continue;
    for (Index k = 0; k < columns_->size(); ++k) {
      const double terms = guard.by_state.cwiseAbs().dot(columns_->x.col(k).cwiseAbs());
      if (std::abs(guard.columns[k]) > column_rounding * terms)
        gaps_->lose(present.t, k, group.name, "the guard was at zero already");
    }
  }
}

// --- at its end

bool GuardsAtZero::waits(std::size_t k) const {
  const Guard& guard = (*guards_)[k];
  return guard.phase == Phase::waiting && std::abs(guards_->g[k]) <= guard.error;
}

/// For a parameter that moves it to the side from which it comes there is an event, and for the other
/// sign there is none.
void GuardsAtZero::look_at_waiting(double t) {
  const std::vector<std::size_t>& active = guards_->active().all;
  if (std::ranges::none_of(active, [this](std::size_t k) { return waits(k); })) return;
  const Eigen::VectorXd flow = probe_->flow(t, machine_->x.data());
  for (const std::size_t k : active)
    if (waits(k) && !(*guards_)[k].monitor) look_at_waiting(t, k, flow);
}

void GuardsAtZero::look_at_waiting(double t, std::size_t number, const Eigen::VectorXd& flow) {
  const Guard& record = (*guards_)[number];
  const GuardGroup& group = machine_->plan().guard(record.group);
  if (group.is_opaque() || record.rests) return;
  const GuardTangent guard = tangent(t, number, *columns_);
  const ZeroSlope along = zero_slope_of(guard, flow);
  const bool rests = along.rests();
  if (!goes_on(group, record.direction, along)) return;
  std::optional<bool> turns;  // whether the truth decides; the same for all columns
  const auto matters = [&](Index k) {
    if (!moves_guard(guard, along, *columns_, k)) return false;
    if (!turns) turns = group.is_crossing() || truths_.decides(group, record.entry, t, flow);
    return *turns || (rests && truths_.bends(group, record.entry, t, k));
  };
  for (Index k = 0; k < columns_->size(); ++k) {
    if (!matters(k)) continue;
    gaps_->lose(t, k, group.name,
                rests ? "the relation rests at its root"
                      : "the guard is at zero, and the flow takes it across");
  }
}

}  // namespace saltus
