// Tangents: across an instant.
#include <algorithm>
#include <cmath>
#include <new>

#include "saltus/simulation/detail/declared_derivatives.hpp"
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

namespace {

/// Two causes have one time for all values of a parameter if its derivatives differ by no more than
/// this part. The differences of called functions have errors of 1e-10 (see TangentProbe), which a
/// slow crossing amplifies.
constexpr double same_time = 1e-6;
/// A column of a guard that is smaller than this part of its terms is zero: the columns of guards that
/// fire together vanish up to the errors of differences (see TangentProbe).
constexpr double column_rounding = 1e-6;
/// The rounding of a guard's value, in parts of its terms and of their movement in a rounding of time.
constexpr double guard_rounding = 1e3 * thresholds::eps;

/// The declared derivatives of a reset map; null if there are none.
const DerivativesFunction* derivatives_of(const PlanLeaf& leaf, const Transition::Call& call) {
  for (const ZeroCrossing& crossing : leaf.declared().zero_crossings)
    if (&crossing.reset_map == call.map && crossing.reset_derivatives)
      return &crossing.reset_derivatives;
  return nullptr;
}

}  // namespace

/// Opens an instant, whose time moves as its causes do.
void Tangents::open(const Present& present, const std::vector<int>& due) {
  t_ = present.t, phase_ = Phase::opened;
  const double* x = machine_->x.data();
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
    } else if (std::abs(columns_.t[k] - moved.by[k]) >
               same_time * std::max(std::abs(columns_.t[k]), std::abs(moved.by[k]))) {
      lose(k, moved.event, "another event happens at the same time, and their order would change");
    }
  }
}

// --- the passes

/// The derivative of what a reset map or an update writes.
void Tangents::call(const Transition::Call& call, const double* x_next, const double* z_next,
                    int mode) {
  const PlanLeaf& leaf = machine_->plan().leaf(call.leaf);
  if (const DerivativesFunction* declared = derivatives_of(leaf, call))
    return call_declared(call, *declared, x_next, z_next, mode);
  Eigen::VectorXd x(leaf.nx), z(leaf.nz), out(leaf.nx + leaf.nz);
  for (Index k = 0; k < size(); ++k) {
    const auto read = [&](Machine& probe, double shift, double* to) {
      for (Index i = 0; i < leaf.nx; ++i)
        x[i] = x_next[leaf.x + i] + shift * next_x_(leaf.x + i, k);
      for (Index i = 0; i < leaf.nz; ++i)
        z[i] = z_next[leaf.z + i] + shift * next_z_(leaf.z + i, k);
      At at = probe.at(call.leaf, call.t + shift * columns_.t[k], probe.x.data());
      at.entry = call.entry, at.mode = mode;
      if (call.before) at.u = inputs_before_.moved(probe, call.leaf, k, shift);
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

/// The same by declared derivatives. The inputs are those of the state before the pass.
void Tangents::call_declared(const Transition::Call& call, const DerivativesFunction& derivatives,
                             const double* x_next, const double* z_next, int mode) {
  const PlanLeaf& leaf = machine_->plan().leaf(call.leaf);
  Machine& probe = probe_.at(machine_->x.data());
  At at = probe.at(call.leaf, call.t, probe.x.data());
  at.entry = call.entry, at.mode = mode;
  new (&at.x) VectorView(x_next + leaf.x, leaf.nx);
  new (&at.z) VectorView(z_next + leaf.z, leaf.nz);
  const Eigen::MatrixXd by = declared_derivatives(leaf, derivatives, at, leaf.nx + leaf.nz,
                                                  text("the reset map of '", call.source, "'"));
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(by.cols(), size());
  each_column(leaf, [&](Index column, const Place& place) {
    const bool own = column < leaf.nx + leaf.nz;
    for (Index k = 0; k < size(); ++k) {
      if (place.space == Space::x)
        values(column, k) = (own ? next_x_ : columns_.x)(place.offset, k);
      else if (place.space == Space::z)
        values(column, k) = (own ? next_z_ : columns_.z)(place.offset, k);
      else if (place.space == Space::p)
        values(column, k) = columns_.p->at(place.offset, k);
      else
        values(column, k) = columns_.y(place.offset, k);
    }
  });
  values.bottomRows(1) = columns_.t;
  const Eigen::MatrixXd next = by * values;
  next_x_.middleRows(leaf.x, leaf.nx) = next.topRows(leaf.nx);
  next_z_.middleRows(leaf.z, leaf.nz) = next.bottomRows(leaf.nz);
}

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
  variation_->forget();
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
