// Tangents: where the derivatives that were computed are none, and why.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

/// A column of a guard that is smaller than this part of its terms is zero: the columns of guards that
/// fire together vanish up to the errors of differences (see TangentProbe).
constexpr double column_rounding = 1e-6;
/// The rounding of a guard's value, in parts of its terms and of their movement in a rounding of time.
constexpr double guard_rounding = 1e3 * thresholds::eps;

}  // namespace

void Tangents::lose(Index k, const std::string& event, const std::string& reason) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  columns_.t[k] = none;
  columns_.x.col(k).setConstant(none), columns_.z.col(k).setConstant(none);
  if (std::exchange(nth(lost_, k), char{1})) return;
  note_gap(t_, k, event, reason);
}

/// The gaps are in order of time. A row may be recorded twice, and has one gap.
void Tangents::note_gap(double t, Index k, const std::string& event, const std::string& reason) {
  std::vector<SensitivityGap>& gaps = results_->sensitivities.gaps;
  const std::string& name = nth(results_->sensitivities.parameters, k);
  const auto later = std::ranges::find_if(gaps, [&](const auto& gap) { return gap.time > t; });
  const bool there = std::any_of(gaps.begin(), later, [&](const auto& gap) {
    return gap.time == t && gap.parameter == name && gap.reason == reason;
  });
  if (!there) gaps.insert(later, {t, event, reason, name});
}

/// Takes the derivatives away that are one-sided at t.
void Tangents::clear_one_sided(double t, const std::string& reason, Eigen::MatrixXd& x,
                               Eigen::MatrixXd& z) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (Index k = 0; k < size(); ++k) {
    if (!one_sided_.holds(t, k)) continue;
    for (Index i = 0; i < x.rows(); ++i)
      if (one_sided_.of_x()(i, k)) x(i, k) = none;
    for (Index i = 0; i < z.rows(); ++i)
      if (one_sided_.of_z()(i, k)) z(i, k) = none;
    note_gap(t, k, one_sided_.event(), reason);
  }
}

/// No column may become NaN in silence.
void Tangents::lose_not_finite(const std::string& event) {
  const std::string& obstacle = probe_.obstacle();
  for (Index k = 0; k < size(); ++k) {
    if (nth(lost_, k) != 0) continue;
    if (columns_.x.col(k).allFinite() && columns_.z.col(k).allFinite() &&
        columns_.y.col(k).allFinite())
      continue;
    lose(k, event, obstacle.empty() ? "the derivative is not finite" : obstacle);
  }
}

/// f may jump where the state is, without an event: a branch that no guard announces. The jump would
/// go through all columns, and the linear equation does not have it.
void Tangents::look_for_jump(double from, double to, const FlowJumps::StateAt& state) {
  if (!jumps_.within(from, to, state, columns_)) return;
  for (Index k = 0; k < size(); ++k) {
    if (columns_.matters(k))
      lose(k, "",
           "the flow jumps without an event; write the branch as a relation, or as modes with a "
           "guard");
  }
}

/// A guard that fires without a root was at zero already, where the run began or where an effect put
/// it. For a parameter that moves it off zero there is an event on one side only.
void Tangents::look_at_firings(const Present& present) {
  if (present.pass == 0) return;  // these are roots
  for (const Firing& firing : present.firings) {
    const std::size_t number = firing.guard();
    const GuardGroup& group = machine_->plan().guard((*guards_)[number].group);
    if (!group.is_crossing()) continue;
    const GuardTangent guard =
        flow_.guard(t_, machine_->x.data(), static_cast<Index>(number), columns_);
    const double rounding =
        guard_rounding *
        guard.by_state.cwiseAbs().dot(
            machine_->x.cwiseAbs() + std::abs(t_) * probe_.flow(t_, machine_->x.data()).cwiseAbs());
    if (std::abs(present.g[number]) > std::max((*guards_)[number].error, rounding)) continue;
    for (Index k = 0; k < size(); ++k) {
      const double terms = guard.by_state.cwiseAbs().dot(columns_.x.col(k).cwiseAbs());
      if (std::abs(guard.columns[k]) > column_rounding * terms)
        lose(k, group.name, "the guard was at zero already");
    }
  }
}

}  // namespace saltus
