// Tangents: across an instant.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

/// A column of a guard that is smaller than this part of its terms is zero: the columns of guards that
/// fire together vanish up to the errors of differences (see TangentProbe).
constexpr double column_rounding = 1e-6;
}  // namespace

/// Opens an instant, whose time moves as its causes do.
void Tangents::open(const Present& present, const std::vector<int>& due,
                    const std::vector<DueNow>& waiting) {
  t_ = present.t, phase_ = Phase::opened;
  const double* x = machine_->x.data();
  // A monitor of the last step may be judged in the instant.
  if (!guards_->monitors.empty() && stages_.has_step()) need_inside();
  before_ = columns_;
  fix_time(probe_, t_, x, before_);
  one_sided_.open(*machine_, before_);
  probe_.note(x, 0.0);
  const TangentColumns until = columns_;
  const Eigen::VectorXd f = probe_.flow(t_, x);
  bool first = true;
  for (const Firing& firing : present.firings) {
    merge(times_.of(firing, present.now(firing.guard()).jumped(), until, t_), first);
    first = false;
  }
  for (const int event : due) {
    merge(times_.of(machine_->plan().scheduled(event), until), first);
    first = false;
  }
  for (const DueNow& one : waiting) {
    merge({.by = waits_.time_of(one.key), .event = one.event}, first);
    first = false;
  }
  look_beside(present, until, f, first);
  if (first) cause_.reset();
  if (first) columns_.t.setZero();
  columns_.x += f * (columns_.t - until.t);
  if (machine_->plan().reads_before) inputs_before_.keep(*machine_, columns_, t_, probe_);
}

/// Takes one more cause of the instant. Where causes move apart, their order matters.
void Tangents::merge(const MovedTime& moved, bool first) {
  if (first) cause_ = moved.event;
  for (Index k = 0; k < size(); ++k) {
    if (!moved.obstacle.empty()) {
      lose(k, moved.event, moved.obstacle);
    } else if (first) {
      columns_.t[k] = moved.by[k];
      if (std::isnan(moved.by[k])) lose(k, moved.event, moved.doubt);
    } else if (std::isnan(moved.by[k]) && !gaps_.lost(k)) {
      lose(k, moved.event, moved.doubt);
    } else if (moves_apart(columns_.t[k], moved.by[k])) {
      lose(k, moved.event, "another event happens at the same time, and their order would change");
    }
  }
}

// --- the passes

void Tangents::commit() {
  columns_.x = next_x_, columns_.z = next_z_;
  phase_ = Phase::committed;
  gaps_.lose_not_finite(t_, probe_.obstacle());
}

/// The held signals, and the moving ones that reset maps read, follow all that they read.
void Tangents::evaluated() {
  if (machine_->y.size() == 0) return;
  Eigen::MatrixXd y(machine_->y.size(), size());
  for (Index k = 0; k < size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* out) {
      probe.evaluate_instant(t_ + shift * columns_.t[k]);
      std::copy_n(probe.y.data(), probe.y.size(), out);
    };
    probe_.derivative(machine_->x.data(), columns_.column(k), y.rows(), read, y.col(k).data());
  }
  columns_.y = std::move(y);
  clear_truths();
  gaps_.lose_not_finite(t_, probe_.obstacle());
}

void Tangents::close() {
  events_.close(columns_.t);
  look_at_waiting();
  if (machine_->carries())
    for (Index k = 0; k < size(); ++k) lose(k, "", "a block is carried by a moving surface");
  TangentColumns fixed = columns_;
  fix_time(probe_, t_, machine_->x.data(), fixed);
  one_sided_.judge(t_, *machine_, columns_, fixed, cause());
  if (!flow_.autonomous()) columns_ = std::move(fixed);
  phase_ = Phase::between;
  look_at_kinks();
  variation_->forget(), stages_.forget();
  if (options_->dense_output) results_->sensitivities.trajectory.instant(probe_.sizes());
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
    const double rounding = rounding_of(guard, probe_.flow(t_, machine_->x.data()));
    if (std::abs(present.g[number]) > std::max((*guards_)[number].error, rounding)) continue;
    for (Index k = 0; k < size(); ++k) {
      const double terms = guard.by_state.cwiseAbs().dot(columns_.x.col(k).cwiseAbs());
      if (std::abs(guard.columns[k]) > column_rounding * terms)
        lose(k, group.name, "the guard was at zero already");
    }
  }
}

void Tangents::accumulate(const void* monitor, std::span<const Index> states,
                          const Eigen::VectorXd& next) {
  if (events_.accumulate(monitor, states, next, next_x_)) return;
  for (Index k = 0; k < size(); ++k) {
    if (!columns_.matters(k)) continue;
    next_x_.col(k).setConstant(TangentGaps::none);
    next_z_.col(k).setConstant(TangentGaps::none);
    lose(k, cause(), "the run began between the last events before the rest; begin it earlier");
  }
}

}  // namespace saltus
