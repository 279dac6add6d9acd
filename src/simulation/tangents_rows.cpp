// Tangents: the rows, the end, and the words about them.
#include <algorithm>
#include <limits>
#include <utility>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

const char* const end_at_event = "the run ends at the time of the event, which moves";
const char* const row_at_event =
    "the row is at the time of the event, which moves; with event_rows it has a row on each side";

std::vector<double> row_major(const Eigen::MatrixXd& values) {
  std::vector<double> out;
  for (Index i = 0; i < values.rows(); ++i)
    for (Index k = 0; k < values.cols(); ++k) out.push_back(values(i, k));
  return out;
}

}  // namespace

void Tangents::record(double t, const double* x) {
  if (in_instant_ && !committed_) return add_row(t, x, before_);
  TangentColumns at = columns_;
  if (!in_instant_ && t < t_) variation_->at(t, at.x);
  fix_time(t, x, at);
  if (in_instant_) one_sided_.judge(t, *machine_, columns_, at, cause_);  // up to this pass
  add_row(t, x, at);
}

/// Turns derivatives at a moving time into those at a fixed time.
void Tangents::fix_time(double t, const double* x, TangentColumns& at) {
  if (at.t.isZero(0.0)) return;
  at.x -= probe_.flow(t, x) * at.t;
  at.t.setZero();
}

/// Adds a row of the derivatives of the recorded signals. Views of states need no differences.
void Tangents::add_row(double t, const double* x, const TangentColumns& at) {
  const Plan& plan = machine_->plan();
  Index width = 0;
  for (const Tap& tap : plan.taps) width += plan.node(tap.node).place.size;
  Eigen::MatrixXd all(width, size());
  const auto read = [&](Machine& probe, double, double* out) {
    const Values values = probe.evaluate_taps(t, probe.x.data());
    for (const Tap& tap : plan.taps) {
      const Place& place = plan.node(tap.node).place;
      out = std::copy_n(values(place), place.size, out);
    }
  };
  for (Index k = 0; k < size(); ++k)
    probe_.derivative(x, at.column(k), width, read, all.col(k).data());
  Eigen::MatrixXd by_x = at.x, by_z = at.z;
  if (!options_->event_rows) {
    clear_one_sided(t, row_at_event, by_x, by_z);
    for (Index k = 0; k < size(); ++k)
      if (one_sided_.holds(t, k)) all.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  Index first = 0;
  for (std::size_t i = 0; i < plan.taps.size(); ++i) {
    const Place& place = plan.node(plan.taps[i].node).place;
    if (place.space == Space::x)
      all.middleRows(first, place.size) = by_x.middleRows(place.offset, place.size);
    if (place.space == Space::z)
      all.middleRows(first, place.size) = by_z.middleRows(place.offset, place.size);
    const auto values = row_major(all.middleRows(first, place.size));
    std::vector<double>& out = results_->sensitivities.signals[i];
    out.insert(out.end(), values.begin(), values.end());
    first += place.size;
  }
}

/// A run that goes on does not end there.
void Tangents::forget_end() {
  if (!std::exchange(ends_at_instant_, false)) return;
  std::erase_if(results_->sensitivities.gaps,
                [](const SensitivityGap& gap) { return gap.reason == end_at_event; });
}

void Tangents::drop() {
  const Plan& plan = machine_->plan();
  for (std::size_t i = 0; i < plan.taps.size(); ++i) {
    std::vector<double>& out = results_->sensitivities.signals[i];
    const auto width = static_cast<std::size_t>(plan.node(plan.taps[i].node).place.size * size());
    out.resize(out.size() - width);
  }
}

void Tangents::finish() {
  Sensitivities& out = results_->sensitivities;
  const std::size_t numbers = results_->events.size() * out.size();
  out.event_times.resize(numbers), out.predicted.resize(numbers);  // a failure takes events back
  TangentColumns at = columns_;
  fix_time(t_, machine_->x.data(), at);
  forget_end();
  if (results_->status == Status::reached_end) {
    clear_one_sided(t_, end_at_event, at.x, at.z);
    ends_at_instant_ = true;
  }
  out.continuous_state = row_major(at.x), out.discrete_state = row_major(at.z);
}

std::string Tangents::describe() const {
  return text("sensitivities: ", options_->sensitivity.size(), " names, ", flow_.describe(), "\n");
}

}  // namespace saltus
