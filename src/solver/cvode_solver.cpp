// CVODE behind the seam: Adams with fixed-point iteration, BDF with Newton and the
// linear solver that suits the scene.
#include "saltus/solver/cvode.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "linear/linear_system.hpp"
#include "saltus/solver/dopri5.hpp"
#include "saltus/solver/runge_kutta.hpp"
#include "saltus/solver/step_size.hpp"
#include "saltus/solver/step_solver.hpp"
#include "small_vector.hpp"
#include "sundials_compat.hpp"

namespace saltus {

extern template class RungeKutta<Dopri5>;  // dopri5_solver.cpp

namespace {

class CvodeSolver final : public StepSolver<CvodeSolver> {
 public:
  CvodeSolver(Machine& machine, Watch& watch, const SolverOptions& options, CvodeMethod method)
      : StepSolver(machine, watch, options),
        method_(method),
        context_(sun::make_context()),
        y_(make_vector(n_, context_.get())),
        dky_(N_VClone(y_.get())),
        cvode_(CVodeCreate(method == CvodeMethod::adams ? CV_ADAMS : CV_BDF, context_.get())),
        starter_(machine, watch, options) {
    if (!cvode_ || !y_ || !dky_) throw Error("SUNDIALS: out of memory");
    hook_ = {
        [](const char* message, void* self) { static_cast<CvodeSolver*>(self)->note(message); },
        this};
    sun::hook_errors(context_.get(), cvode_.get(), &hook_);
  }

  void inside_step(double u, double* x) {
    if (starting_) return starter_.inside_step(u, x);
    if (CVodeGetDky(cvode_.get(), t0_ + u, 0, dky_.get()) < 0) fail(t0_ + u);
    std::copy_n(N_VGetArrayPointer(dky_.get()), n_, x);
  }

  const SolverStatistics& statistics() const override {
    sum_ = statistics_;
    add_counts(sum_);
    if (linear_) sum_.linear_solver = linear_->describe();
    return sum_;
  }

  int degree() const override {
    if (starting_) return starter_.degree();
    int order = 0;
    CVodeGetLastOrder(cvode_.get(), &order);
    return order;
  }

  std::string method() const override { return method_ == CvodeMethod::adams ? "adams" : "bdf"; }

 private:
  friend StepSolver<CvodeSolver>;

  void begin(const Start& how) {
    if (how.first) first_step_ = 0.0;
    begun_at_ = t1_;
    // A multistep method begins with order 1 and steps that keep that within the tolerance. A
    // flight hardly longer than those is drawn as a line that falls from the start: the ball would
    // fall through. So a one-step method starts where an event may follow that soon (C. W. Gear,
    // "Runge-Kutta starters for multistep methods", ACM TOMS 6 (1980) 263), and CVODE takes over
    // once the flight has proved longer.
    starting_ = how.horizon < 2e4 * first_step_;
    if (starting_)
      start_with_one_step(t1_, x1_, how.horizon);
    else
      start_cvode(how.first);
  }

  static N_Vector make_vector(Index n, SUNContext context) {
    N_Vector vector = N_VNew_Serial(static_cast<sunindextype>(n), context);
    if (vector == nullptr) throw Error("SUNDIALS: out of memory");
    sun::use_small_operations(vector);
    return vector;
  }

  void start_with_one_step(double t, const Eigen::VectorXd& x, double horizon) {
    starting_ = true;
    starter_until_ = t + 4.0 * horizon;
    starter_.begin_at(t, x, {.horizon = horizon, .first = true});
  }

  void start_cvode(bool first = false) {
    starting_ = false;
    steps_ = 0;
    std::copy_n(x1_.data(), n_, N_VGetArrayPointer(y_.get()));
    if (!started_) {
      create();
    } else {
      if (!first) add_counts(statistics_);
      if (CVodeReInit(cvode_.get(), t1_, y_.get()) < 0) fail(t1_);
    }
    aim();
  }

  void create() {
    void* cvode = cvode_.get();
    if (CVodeInit(cvode, right_hand_side, t1_, y_.get()) < 0) fail(t1_);
    CVodeSetUserData(cvode, this);
    CVodeSStolerances(cvode, options_.rtol, options_.atol);
    CVodeSetMaxHnilWarns(cvode, -1);
    CVodeSetMaxConvFails(cvode, 20);
    if (options_.min_step > 0.0) CVodeSetMinStep(cvode, options_.min_step);
    if (std::isfinite(options_.max_step)) CVodeSetMaxStep(cvode, options_.max_step);
    if (method_ == CvodeMethod::adams) {
      nonlinear_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_.get()));
      CVodeSetNonlinearSolver(cvode, nonlinear_.get());
    } else {
      linear_.emplace(*machine_, options_, error_, t1_, x1_.data());
      attach_linear();
    }
    watch_guards();
    started_ = true;
  }

  void attach_linear() {
    linear_->attach(cvode_.get(), y_.get(), context_.get(), {jacobian, prepare, precondition});
  }

  /// Only a scene with guards that stop the solver has root-finding. CVodeReInit would keep guards
  /// switched off that were zero once; none is, since CVODE is never shown a zero: shown().
  void watch_guards() {
    if (std::ranges::all_of(watch_->slots, &GuardSlot::monitor)) return;
    directions_.resize(watch_->slots.size()), asked_.resize(watch_->slots.size());
    CVodeRootInit(cvode_.get(), static_cast<int>(directions_.size()), root_functions);
    CVodeSetNoInactiveRootWarn(cvode_.get());
  }

  /// The directions of now: a guard on Zeno hold is watched the other way round.
  void aim() {
    if (directions_.empty()) return;
    std::ranges::transform(watch_->slots, directions_.begin(), [](const GuardSlot& slot) {
      return slot.direction == Direction::positive_then_non_positive   ? -1
             : slot.direction == Direction::negative_then_non_negative ? 1
                                                                       : 0;
    });
    CVodeSetRootDirection(cvode_.get(), directions_.data());
  }

  void undo() { t1_ = t0_; }

  /// CVODE has looked at the end of its step just now.
  const double* end_guards() const {
    return !starting_ && !asked_.empty() && asked_at_ == t1_ ? asked_.data() : nullptr;
  }

  void step(double t_stop) {
    if (starting_ && t1_ >= starter_until_) start_cvode();
    // CVODE takes no step within a few roundings of the time.
    const double shortest = std::max(
        64.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t_stop), std::abs(t1_)),
        1e-290);
    if (!starting_ && t_stop - t1_ < shortest) {
      start_with_one_step(t1_, x1_, t_stop - t1_);
      starter_until_ = t_stop;
    }
    if (!starting_) cvode_step(t_stop);
    if (!starting_) return;
    starter_.bare_step(t_stop);
    ++statistics_.steps;
    t1_ = starter_.step_end(), length_ = starter_.step_length(), x1_ = starter_.step_state();
  }

  void cvode_step(double t_stop) {
    if (CVodeSetStopTime(cvode_.get(), t_stop) < 0) fail(t0_);
    double t = t0_;
    const int flag = CVode(cvode_.get(), t_stop, y_.get(), &t, CV_ONE_STEP);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    if (flag < 0 && linear_ && linear_->renew(flag)) {
      last_message_.clear();
      attach_linear(), start_cvode();
      return cvode_step(t_stop);
    }
    if (flag < 0) fail(t);
    if (steps_ == 0) CVodeGetActualInitStep(cvode_.get(), &first_step_);
    if (flag == CV_ROOT_RETURN && too_coarse()) {
      start_with_one_step(t0_, x1_, first_step_);
      return;
    }
    ++steps_;
    t1_ = flag == CV_TSTOP_RETURN ? t_stop : t;
    length_ = t1_ - t0_;
    standing_ =
        length_ > 16.0 * std::numeric_limits<double>::epsilon() * std::abs(t0_) ? 0 : standing_ + 1;
    if (standing_ > 100)
      throw_step_too_small(*machine_, t0_, length_, x1_.data(),
                           options_);  // CVODE itself would go on
    std::copy_n(N_VGetArrayPointer(y_.get()), n_, x1_.data());
  }

  /// A guard that was at zero when this stretch began, found at zero again within the two steps of
  /// order 1.
  bool too_coarse() const {
    return steps_ < 2 && std::ranges::any_of(watch_->slots, [](const GuardSlot& slot) {
             return slot.active && slot.fresh && !slot.monitor;
           });
  }

  void add_counts(SolverStatistics& to) const {
    if (!started_) return;
    long steps = 0, rejected = 0, setups = 0;
    CVodeGetNumSteps(cvode_.get(), &steps);
    CVodeGetNumErrTestFails(cvode_.get(), &rejected);
    CVodeGetNumLinSolvSetups(cvode_.get(), &setups);
    to.steps += steps, to.rejected += rejected, to.linear_setups += setups;
  }

  // --- what CVODE calls; nothing may be thrown through it
  // -----------------------------------------------------

  /// Keeps the first exception of a callback: CVODE tries ten times more before it gives up.
  template <class Call>
  int guarded(Call call) {
    if (error_) return -1;
    try {
      return call();
    } catch (...) {
      error_ = std::current_exception();
      return -1;
    }
  }

  static int right_hand_side(double t, N_Vector x, N_Vector xdot, void* user) {
    auto* self = static_cast<CvodeSolver*>(user);
    return self->guarded([&] {
      double* out = N_VGetArrayPointer(xdot);
      self->machine_->derivative(t, N_VGetArrayPointer(x), out);
      return VectorView(out, self->n_).allFinite() ? 0 : 1;  // 1: try a shorter step
    });
  }

  static int jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out, void* user, N_Vector,
                      N_Vector, N_Vector) {
    auto* self = static_cast<CvodeSolver*>(user);
    return self->guarded([&] { return self->linear_->jacobian(t, x, xdot, out); });
  }
  static int prepare(double t, N_Vector x, N_Vector xdot, sunbooleantype keep,
                     sunbooleantype* renewed, double gamma, void* user) {
    auto* self = static_cast<CvodeSolver*>(user);
    return self->guarded([&] {
      bool fresh = false;
      const int flag = self->linear_->prepare(t, x, xdot, keep != 0, fresh, gamma);
      *renewed = static_cast<sunbooleantype>(fresh);
      return flag;
    });
  }
  static int precondition(double, N_Vector, N_Vector, N_Vector r, N_Vector z, double, double, int,
                          void* user) {
    auto* self = static_cast<CvodeSolver*>(user);
    return self->guarded([&] { return self->linear_->precondition(r, z); });
  }

  /// CVODE only wakes us; the locator judges. So it never sees an exact zero at the start of a
  /// stretch, which would switch the guard off, nor a monitor.
  static int root_functions(double t, N_Vector x, double* g, void* user) {
    auto* self = static_cast<CvodeSolver*>(user);
    return self->guarded([&] {
      self->machine_->guards(t, N_VGetArrayPointer(x), g);
      std::copy_n(g, self->asked_.size(), self->asked_.data());
      self->asked_at_ = t;
      for (std::size_t k = 0; k < self->watch_->slots.size(); ++k) g[k] = self->shown(k, t, g[k]);
      return 0;
    });
  }

  double shown(std::size_t k, double t, double value) const {
    const GuardSlot& slot = watch_->slots[k];
    constexpr double tiny =
        1e-100;  // CVODE multiplies values to compare signs: nothing it sees may underflow then
    if (!slot.active || slot.monitor) return 1.0;
    if (slot.leaving) return std::abs(value) > slot.band ? -tiny : tiny;
    if (slot.direction == Direction::edge_detection) return value == slot.base ? 1.0 : -1.0;
    const double side = slot.side < 0 ? -tiny : tiny;
    if (slot.waits() && t == begun_at_) return side;
    if (std::abs(value) > slot.band) return std::copysign(std::max(std::abs(value), tiny), value);
    return slot.waits() || slot.side == 0 ? side : -side;
  }

  void note(const char* message) {
    if (last_message_.empty()) last_message_ = message;
  }

  [[noreturn]] void fail(double t) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    double h = 0.0;
    CVodeGetCurrentTime(cvode_.get(), &t);
    CVodeGetCurrentStep(cvode_.get(), &h);
    require_finite_near(*machine_, t, h, x1_.data());
    if (options_.min_step > 0.0) throw_step_too_small(*machine_, t, h, x1_.data(), options_);
    const std::string block = fastest_block(*machine_, t, x1_.data(), options_);
    throw SimulationError(
        text("t = ", t, " s: CVODE (", method(), ") cannot go on, step ", h, " s: ", last_message_,
             "; the solution blows up in finite time, has a jump that no guard announces, or the "
             "tolerance cannot be met; block '",
             block, "' moves fastest; rtol = ", options_.rtol, ", atol = ", options_.atol),
        t, block);
  }

  CvodeMethod method_;
  sun::ErrorHook hook_;
  std::string last_message_;
  std::exception_ptr error_;
  sun::Context context_;
  sun::Vector y_, dky_;
  sun::Nonlinear nonlinear_;
  std::optional<LinearSystem> linear_;  // of BDF
  sun::Cvode cvode_;
  std::vector<int> directions_;  // of the guards; empty without root-finding
  std::vector<double> asked_;    // the guards when CVODE last asked for them
  double asked_at_ = 0.0;
  RungeKutta<Dopri5> starter_;
  bool started_ = false, starting_ = false;
  double begun_at_ = 0.0, first_step_ = 0.0, starter_until_ = 0.0;
  int steps_ = 0;     // of CVODE since it was started
  int standing_ = 0;  // steps in a row that drown in the rounding of t
  mutable SolverStatistics sum_;
};

}  // namespace

std::unique_ptr<Solver> make_cvode(Machine& machine, Watch& watch, const SolverOptions& options,
                                   CvodeMethod method) {
  return std::make_unique<CvodeSolver>(machine, watch, options, method);
}

}  // namespace saltus
