// Tangents: across an instant.
#include <cmath>
#include <limits>
#include <new>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

constexpr double no_derivative = std::numeric_limits<double>::quiet_NaN();
/// Two causes have one time for all values of a parameter if its derivatives differ by no more than
/// this part. The differences of called functions have errors of 1e-10 (see TangentProbe), which a
/// slow crossing amplifies.
constexpr double same_time = 1e-6;
/// The rounding of a sum such as dg/dx f + dg/dt, in parts of its terms.
constexpr double sum_rounding = 1e3 * thresholds::eps;

}  // namespace

/// Opens an instant, whose time moves as its causes do.
void Tangents::open(const Present& present, const std::vector<int>& due) {
  t_ = present.t, in_instant_ = true, committed_ = false;
  const double* x = machine_->x.data();
  before_ = columns_;
  fix_time(t_, x, before_);
  probe_.note(x, 0.0);
  const TangentColumns until = columns_;
  const Eigen::VectorXd f = flow(t_, x);
  bool first = true;
  for (const Firing& firing : present.firings) {
    merge(moved_by(firing, present.now(firing.guard()).jumped, until, t_), first);
    first = false;
  }
  for (const int event : due) {
    merge(moved_by(machine_->plan().scheduled(event), until), first);
    first = false;
  }
  has_cause_ = !first;
  if (first) columns_.t.setZero();
  columns_.x += f * (columns_.t - until.t);
}

/// Takes one more cause of the instant. Where causes move apart, their order matters.
void Tangents::merge(const Moved& moved, bool first) {
  for (Index k = 0; k < size(); ++k) {
    if (!moved.obstacle.empty()) {
      lose(k, moved.event, moved.obstacle);
    } else if (first) {
      columns_.t[k] = moved.by[k];
      if (std::isnan(moved.by[k])) lose(k, moved.event, moved.doubt);
    } else if (std::abs(columns_.t[k] - moved.by[k]) >
               same_time * std::max(std::abs(columns_.t[k]), std::abs(moved.by[k]))) {
      lose(k, moved.event, "another event happens at the same time, and their order would change");
    }
  }
}

Tangents::Moved Tangents::moved_by(const Firing& firing, bool jumped, const TangentColumns& until,
                                   double t) {
  const Guard& guard = (*guards_)[firing.guard()];
  const GuardGroup& group = machine_->plan().guard(guard.group);
  if (guard.phase == Phase::resting || guard.phase == Phase::carried ||
      firing.from == Firing::lifts_off)
    return {.event = group.name, .obstacle = "the guard was at rest"};
  if (group.is_opaque())
    return {.event = group.name,
            .obstacle = "a called function decides it, which shows a sign only"};
  if (jumped) return {.event = group.name, .obstacle = "the guard jumps across zero"};
  return crossing_time(firing.slot, group.name, t, machine_->x.data(), until);
}

/// A time event happens at a fixed time, or at a time that follows from a discrete state.
Tangents::Moved Tangents::moved_by(const ScheduledEvent& event, const TangentColumns& until) {
  Moved moved{.by = Eigen::RowVectorXd::Zero(size()), .event = event.name};
  if (!event.by_state) return moved;
  const PlanLeaf& leaf = machine_->plan().leaf(event.leaf);
  const auto& next = machine_->plan().time_event_of(event).next;
  const auto read = [&](Machine& probe, double, double* out) {
    *out = next(VectorView(probe.z.data() + leaf.z, leaf.nz));
  };
  for (Index k = 0; k < size(); ++k)
    probe_.derivative(machine_->x.data(), until.column(k), 1, read, &moved.by[k]);
  return moved;
}

/// dtau = -(g_x S + g_p) / (g_x f- + g_t), added to the time by which the columns move already; NaN
/// where the guard grazes zero.
Tangents::Moved Tangents::crossing_time(Index slot, const std::string& event, double t,
                                        const double* x, const TangentColumns& until) {
  const GuardTangent guard = flow_.guard(t, x, slot, until);
  const double speed = guard.by_state.dot(flow(t, x)) + guard.by_time;
  Moved moved{.by = until.t - guard.columns / speed, .event = event};
  if (!guard.columns.allFinite() || !std::isfinite(speed))
    moved.doubt = "the derivative of the guard is not finite";
  const bool flat = guard.by_state.isZero(0.0) && guard.by_time == 0.0;
  const bool at_rest = grazes(guard, speed, slot, t, x);
  for (Index k = 0; k < size(); ++k) {
    // A guard that does not depend on the parameter has a time all the same.
    const bool independent = flat ? !matters(k) : guard.columns[k] == 0.0;
    if (at_rest) moved.by[k] = independent ? until.t[k] : no_derivative;
  }
  return moved;
}

/// Whether a guard reaches zero so slowly that it would turn back within the error of its value. With
/// the speed s and the curvature c against it, it goes beyond zero by s^2 / (2 |c|). The error of its
/// value follows from the tolerances of the states that it reads.
bool Tangents::grazes(const GuardTangent& guard, double speed, Index slot, double t,
                      const double* x) {
  const Eigen::VectorXd f = flow(t, x);
  const double terms = guard.by_state.cwiseAbs().dot(f.cwiseAbs()) + std::abs(guard.by_time);
  if (!(std::abs(speed) > sum_rounding * terms)) return true;
  double error = 0.0;
  for (Index i = 0; i < f.size(); ++i)
    error += std::abs(guard.by_state[i]) * (options_->atol[i] + options_->rtol[i] * std::abs(x[i]));
  const double ahead = std::sqrt(2.0 * error / terms / std::max(terms, 1.0));
  if (!(ahead > 0.0) || !std::isfinite(ahead)) return false;
  const Eigen::VectorXd later = VectorView(x, f.size()) + ahead * f;
  const GuardTangent there = flow_.guard(t + ahead, later.data(), slot, before_);
  const double curvature =
      (there.by_state.dot(flow(t + ahead, later.data())) + there.by_time - speed) / ahead;
  return curvature * speed < 0.0 && speed * speed <= 2.0 * std::abs(curvature) * error;
}

// --- the passes

void Tangents::begin_pass() { next_x_ = columns_.x, next_z_ = columns_.z; }

/// The derivative of what a reset map or an update writes.
void Tangents::call(const Transition::Call& call, const double* x_next, const double* z_next,
                    int mode) {
  const PlanLeaf& leaf = machine_->plan().leaf(call.leaf);
  Eigen::VectorXd x(leaf.nx), z(leaf.nz), out(leaf.nx + leaf.nz);
  for (Index k = 0; k < size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* to) {
      for (Index i = 0; i < leaf.nx; ++i)
        x[i] = x_next[leaf.x + i] + shift * next_x_(leaf.x + i, k);
      for (Index i = 0; i < leaf.nz; ++i)
        z[i] = z_next[leaf.z + i] + shift * next_z_(leaf.z + i, k);
      At at = probe.at(call.leaf, call.t + shift * columns_.t[k], probe.x.data());
      at.entry = call.entry, at.mode = mode;
      new (&at.x) VectorView(x.data(), leaf.nx);
      new (&at.z) VectorView(z.data(), leaf.nz);
      const VectorRef to_x(to, leaf.nx), to_z(to + leaf.nx, leaf.nz);
      std::copy_n(x.data(), leaf.nx, to), std::copy_n(z.data(), leaf.nz, to + leaf.nx);
      int entered = mode;
      Next next(to_x, to_z, entered, leaf.path);
      (*call.map)(*leaf.system, at, next);
    };
    probe_.derivative(machine_->x.data(), columns_.column(k), out.size(), read, out.data());
    next_x_.col(k).segment(leaf.x, leaf.nx) = out.head(leaf.nx);
    next_z_.col(k).segment(leaf.z, leaf.nz) = out.tail(leaf.nz);
  }
}

void Tangents::commit() {
  columns_.x = next_x_, columns_.z = next_z_;
  committed_ = true;
  lose_not_finite("");
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
  lose_not_finite("");
}

void Tangents::close() {
  instant_time_ = columns_.t;
  if (machine_->carries())
    for (Index k = 0; k < size(); ++k) lose(k, "", "a block is carried by a moving surface");
  if (!flow_.autonomous()) fix_time(t_, machine_->x.data(), columns_);
  in_instant_ = false;
  variation_->forget();
}

}  // namespace saltus
