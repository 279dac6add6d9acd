#include "saltus/simulation/detail/tangent_rows.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

namespace {

const char* const row_at_event =
    "the row is at the time of the event, which moves; with event_rows it has a row on each side";

void append_row_major(const Eigen::MatrixXd& values, std::vector<double>& out) {
  for (Index i = 0; i < values.rows(); ++i)
    for (Index k = 0; k < values.cols(); ++k) out.push_back(values(i, k));
}

}  // namespace

void TangentRows::begin(std::vector<std::string> parameters) {
  Sensitivities& out = results_->sensitivities;
  out = {};
  out.parameters = std::move(parameters);
  out.signals.resize(machine_->plan().taps.size());
}

/// The derivatives of all recorded signals by differences, a column for each parameter.
Eigen::MatrixXd TangentRows::differences(double t, const double* x, const TangentColumns& at) {
  const Plan& plan = machine_->plan();
  Index width = 0;
  for (const Tap& tap : plan.taps) width += plan.node(tap.node).place.size;
  Eigen::MatrixXd all(width, at.size());
  const auto read = [&](Machine& probe, double, double* out) {
    const Values values = probe.evaluate_taps(t, probe.x.data());
    for (const Tap& tap : plan.taps) {
      const Place& place = plan.node(tap.node).place;
      out = std::copy_n(values(place), place.size, out);
    }
  };
  for (Index k = 0; k < at.size(); ++k)
    probe_->derivative(x, at.column(k), width, read, all.col(k).data());
  return all;
}

/// Views of states need no differences.
void TangentRows::add(double t, const double* x, const TangentColumns& at,
                      const OneSided& one_sided) {
  const Plan& plan = machine_->plan();
  Eigen::MatrixXd all = differences(t, x, at), by_x = at.x, by_z = at.z;
  if (!options_->event_rows) {
    gaps_->clear(one_sided, t, row_at_event, by_x, by_z);
    for (Index k = 0; k < at.size(); ++k)
      if (one_sided.holds(t, k)) all.col(k).setConstant(TangentGaps::none);
  }
  Index first = 0;
  for (std::size_t i = 0; i < plan.taps.size(); ++i) {
    const Place& place = plan.node(plan.taps[i].node).place;
    if (place.space == Space::x)
      all.middleRows(first, place.size) = by_x.middleRows(place.offset, place.size);
    if (place.space == Space::z)
      all.middleRows(first, place.size) = by_z.middleRows(place.offset, place.size);
    append_row_major(all.middleRows(first, place.size), results_->sensitivities.signals[i]);
    first += place.size;
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

void TangentRows::finish(const TangentColumns& at) {
  Sensitivities& out = results_->sensitivities;
  out.continuous_state.clear(), out.discrete_state.clear();
  append_row_major(at.x, out.continuous_state), append_row_major(at.z, out.discrete_state);
}

}  // namespace saltus
