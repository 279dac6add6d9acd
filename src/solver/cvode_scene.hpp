// The scene for CVODE's calls. No exception may pass through C.
#pragma once

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "linear/linear_system.hpp"
#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/solver/detail/cvode_thresholds.hpp"
#include "saltus/solver/detail/guard_set.hpp"
#include "sundials_compat.hpp"

namespace saltus {

/// The user data of a CVODE object: right-hand side, guards, and for BDF the linear system.
class CvodeScene {
 public:
  CvodeScene(Machine& machine, GuardSet& guards) : machine_(&machine), guards_(&guards) {}
  CvodeScene(const CvodeScene&) = delete;  // CVODE keeps its address
  CvodeScene& operator=(const CvodeScene&) = delete;

  static int right_hand_side(double t, N_Vector x, N_Vector xdot, void* user) {
    auto* self = static_cast<CvodeScene*>(user);
    return self->guarded([&] {
      double* out = N_VGetArrayPointer(xdot);
      self->machine_->derivative(t, N_VGetArrayPointer(x), out);
      return VectorView(out, N_VGetLength(xdot)).allFinite() ? 0 : 1;  // 1: try a shorter step
    });
  }

  /// Throws the exception of a callback, if any.
  void rethrow() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

  /// Gives `weights` its tolerances, which have to outlive this scene.
  void weigh_by(const SolverOptions& options) { options_ = &options; }
  /// CVODE's weights of the error, one over the tolerance of each state.
  static int weights(N_Vector x, N_Vector out, void* user) {
    const SolverOptions& options = *static_cast<const CvodeScene*>(user)->options_;
    const double* state = N_VGetArrayPointer(x);
    double* weight = N_VGetArrayPointer(out);
    for (Index i = 0; i < N_VGetLength(x); ++i)
      weight[i] = 1.0 / options.tolerance(i, std::abs(state[i]));
    return 0;
  }

  // --- the linear systems of BDF

  void make_linear(const SolverOptions& options, double t, const double* x) {
    linear_.emplace(*machine_, options, error_, t, x);
  }
  void attach_linear(void* cvode, N_Vector y, SUNContext context) {
    linear_->attach(cvode, y, context, {jacobian, prepare, precondition});
  }
  /// See LinearSystem::renew.
  bool renew_linear(int flag) { return linear_ && linear_->renew(flag); }
  /// Empty if there is no linear system.
  std::string_view describe_linear() const {
    return linear_ ? std::string_view(linear_->describe()) : std::string_view();
  }

  // --- guards

  /// Switches root-finding on if some guard stops the solver. CVodeReInit would keep guards
  /// switched off that were zero once. CVODE never gets a zero, so this does not happen: see
  /// shown().
  void watch_guards(void* cvode) {
    if (std::ranges::all_of(guards_->all(), &Guard::monitor)) return;
    directions_.resize(guards_->all().size()), asked_.resize(guards_->g.size());
    CVodeRootInit(cvode, static_cast<int>(directions_.size()), root_functions);
    CVodeSetNoInactiveRootWarn(cvode);
  }

  /// Gives CVODE the present directions. The guard of a carried block is watched for its lift.
  void aim(void* cvode) {
    if (directions_.empty()) return;
    std::ranges::transform(guards_->all(), directions_.begin(), [](const Guard& guard) {
      const Direction direction = guard.watched_direction();
      return direction == Direction::positive_then_non_positive   ? -1
             : direction == Direction::negative_then_non_negative ? 1
                                                                  : 0;
    });
    CVodeSetRootDirection(cvode, directions_.data());
  }

  /// A stretch begins here.
  void begin_at(double t) { begun_at_ = t; }
  /// The guards, if CVODE's last look at them was at this time.
  const double* guards_at(double t) const {
    return !asked_.empty() && asked_at_ == t ? asked_.data() : nullptr;
  }

 private:
  /// Keeps the first exception of a callback, because CVODE tries ten times more before it fails.
  template <class Call>
  int guarded(Call call) {
    if (error_) return -1;
    try {
      return call();
    } catch (...) {
      detail::pass_end_of_thread();
      error_ = std::current_exception();
      return -1;
    }
  }

  static int jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out, void* user, N_Vector,
                      N_Vector, N_Vector) {
    auto* self = static_cast<CvodeScene*>(user);
    return self->guarded([&] { return self->linear_->jacobian(t, x, xdot, out); });
  }
  static int prepare(double t, N_Vector x, N_Vector xdot, sunbooleantype keep,
                     sunbooleantype* renewed, double gamma, void* user) {
    auto* self = static_cast<CvodeScene*>(user);
    return self->guarded([&] {
      bool fresh = false;
      const int flag = self->linear_->prepare(t, x, xdot, keep != 0, fresh, gamma);
      *renewed = static_cast<sunbooleantype>(fresh);
      return flag;
    });
  }
  static int precondition(double, N_Vector, N_Vector, N_Vector r, N_Vector z, double, double, int,
                          void* user) {
    auto* self = static_cast<CvodeScene*>(user);
    return self->guarded([&] { return self->linear_->precondition(r, z); });
  }

  /// CVODE only reports that a guard may have crossed; the locator decides. So CVODE gets no
  /// monitor, and no exact zero at the start of a stretch, which would switch the guard off.
  static int root_functions(double t, N_Vector x, double* g, void* user) {
    auto* self = static_cast<CvodeScene*>(user);
    return self->guarded([&] {
      const double* asked = self->asked_.data();
      self->machine_->guards(t, N_VGetArrayPointer(x), self->asked_.data());
      self->asked_at_ = t;
      for (std::size_t k = 0; k < self->guards_->all().size(); ++k)
        g[k] = self->shown(k, t, asked[k]);
      return 0;
    });
  }

  double shown(std::size_t k, double t, double value) const {
    const Guard& guard = (*guards_)[k];
    const double tiny = thresholds::least_shown;
    if (!guard.active || guard.monitor) return 1.0;
    if (guard.phase == Phase::resting) return std::abs(value) > guard.error ? -tiny : tiny;
    if (guard.watched_direction() == Direction::edge_detection)
      return value == guard.base ? 1.0 : -1.0;
    return shown_side(guard, t, value, guard.side < 0 ? -tiny : tiny, tiny);
  }
  double shown_side(const Guard& guard, double t, double value, double side, double tiny) const {
    if (guard.waits() && t == begun_at_) return side;
    if (std::abs(value) > guard.error) return std::copysign(std::max(std::abs(value), tiny), value);
    return guard.waits() || guard.side == 0 ? side : -side;
  }

  Machine* machine_;
  GuardSet* guards_;
  const SolverOptions* options_ = nullptr;
  std::exception_ptr error_;
  std::optional<LinearSystem> linear_;
  std::vector<int> directions_;  // of all guards; empty without root-finding
  std::vector<double> asked_;    // the guards at CVODE's last call
  double asked_at_ = 0.0, begun_at_ = 0.0;
};

}  // namespace saltus
