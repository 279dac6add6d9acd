#include "saltus/simulation/detail/tangent_gaps.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

namespace {

const char* const end_at_event = "the run ends at the time of the event, which moves";
const char* const end_at_jump = "the run ends at a jump of the flow, which moves";

}  // namespace

void TangentGaps::lose(double t, Index k, const std::string& event, const std::string& reason) {
  columns_->t[k] = none;
  columns_->x.col(k).setConstant(none), columns_->z.col(k).setConstant(none);
  if (std::exchange(nth(lost_, k), char{1})) return;
  note(t, k, event, reason);
}

void TangentGaps::lose_not_finite(double t, const std::string& obstacle) {
  for (Index k = 0; k < columns_->size(); ++k) {
    if (lost(k)) continue;
    if (columns_->x.col(k).allFinite() && columns_->z.col(k).allFinite() &&
        columns_->y.col(k).allFinite())
      continue;
    lose(t, k, "", obstacle.empty() ? "the derivative is not finite" : obstacle);
  }
}

/// The gaps are in order of time. A row may be recorded twice, and has one gap.
void TangentGaps::note(double t, Index k, const std::string& event, const std::string& reason) {
  std::vector<SensitivityGap>& gaps = results_->sensitivities.gaps;
  const std::string& name = nth(results_->sensitivities.parameters, k);
  const auto later = std::ranges::find_if(gaps, [&](const auto& gap) { return gap.time > t; });
  const bool there = std::any_of(gaps.begin(), later, [&](const auto& gap) {
    return gap.time == t && gap.parameter == name && gap.reason == reason;
  });
  if (!there) gaps.insert(later, {t, event, reason, name});
}

void TangentGaps::clear(const OneSided& one_sided, double t, const std::string& reason,
                        Eigen::MatrixXd& x, Eigen::MatrixXd& z) {
  for (Index k = 0; k < columns_->size(); ++k) {
    if (!one_sided.holds(t, k)) continue;
    for (Index i = 0; i < x.rows(); ++i)
      if (one_sided.of_x()(i, k)) x(i, k) = none;
    for (Index i = 0; i < z.rows(); ++i)
      if (one_sided.of_z()(i, k)) z(i, k) = none;
    note(t, k, one_sided.event(), reason);
  }
}

void TangentGaps::clear(const AtJump& jump, double t, const std::string& reason,
                        Eigen::MatrixXd& x) {
  for (Index k = 0; k < jump.cols(); ++k) {
    if (!jump.col(k).any() || lost(k)) continue;
    for (Index i = 0; i < x.rows(); ++i)
      if (jump(i, k)) x(i, k) = none;
    note(t, k, "", reason);
  }
}

void TangentGaps::end(const OneSided& one_sided, const AtJump& jump, double t, Eigen::MatrixXd& x,
                      Eigen::MatrixXd& z) {
  clear(one_sided, t, end_at_event, x, z);
  clear(jump, t, end_at_jump, x);
  ends_at_instant_ = true;
}

void TangentGaps::forget_end() {
  if (!std::exchange(ends_at_instant_, false)) return;
  std::erase_if(results_->sensitivities.gaps, [](const SensitivityGap& gap) {
    return gap.reason == end_at_event || gap.reason == end_at_jump;
  });
}

}  // namespace saltus
