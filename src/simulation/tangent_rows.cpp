#include "saltus/simulation/detail/tangent_rows.hpp"

#include <utility>

#include "saltus/simulation/detail/signal_tangents.hpp"

namespace saltus {

namespace {

const char* const row_at_event =
    "the row is at the time of the event, which moves; with event_rows it has a row on each side";

const char* const row_at_jump = "the row is at the time of a jump of the flow, which moves";

void append_row_major(const Eigen::MatrixXd& values, std::vector<double>& out) {
  for (Index i = 0; i < values.rows(); ++i)
    for (Index k = 0; k < values.cols(); ++k) out.push_back(values(i, k));
}

}  // namespace

void TangentRows::begin(std::vector<std::string> parameters) {
  Sensitivities& out = results_->sensitivities;
  out = {};
  out.parameters = names_ = std::move(parameters);
  out.signals.resize(machine_->plan().taps.size());
}

void TangentRows::add(double t, const double* x, const TangentColumns& at,
                      const OneSided& one_sided, const AtJump& jump) {
  const Plan& plan = machine_->plan();
  Eigen::MatrixXd all = signal_tangents(*probe_, plan, t, x, at), by_x = at.x, by_z = at.z;
  if (!options_->event_rows) {
    gaps_->clear(one_sided, t, row_at_event, by_x, by_z);
    for (Index k = 0; k < at.size(); ++k)
      if (one_sided.holds(t, k)) all.col(k).setConstant(TangentGaps::none);
  }
  gaps_->clear(jump, t, row_at_jump, by_x);
  for (Index k = 0; k < jump.cols(); ++k)
    if (jump.col(k).any()) all.col(k).setConstant(TangentGaps::none);
  put_views(plan, by_x, by_z, all);
  Index first = 0;
  for (std::size_t i = 0; i < plan.taps.size(); ++i) {
    const Index size = plan.node(plan.taps[i].node).place.size;
    append_row_major(all.middleRows(first, size), results_->sensitivities.signals[i]);
    first += size;
  }
}

void TangentRows::drop() {
  const Plan& plan = machine_->plan();
  for (std::size_t i = 0; i < plan.taps.size(); ++i) {
    std::vector<double>& out = results_->sensitivities.signals[i];
    const auto width = static_cast<std::size_t>(plan.node(plan.taps[i].node).place.size);
    out.resize(out.size() - width * results_->sensitivities.size());
  }
}

void TangentRows::finish(double t, TangentColumns at, const OneSided& one_sided,
                         const AtJump& jump) {
  if (results_->status == Status::reached_end) gaps_->end(one_sided, jump, t, at.x, at.z);
  Sensitivities& out = results_->sensitivities;
  out.continuous_state.clear(), out.discrete_state.clear();
  append_row_major(at.x, out.continuous_state), append_row_major(at.z, out.discrete_state);
}

}  // namespace saltus
