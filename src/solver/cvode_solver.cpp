// CVODE as a Solver: Adams with fixed-point iteration, BDF with Newton and the linear solver that
// suits the scene.
#include "saltus/solver/detail/cvode.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "corrector.hpp"
#include "cvode_scene.hpp"
#include "cvode_setup.hpp"
#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/solver/detail/cvode_start.hpp"
#include "saltus/solver/detail/cvode_thresholds.hpp"
#include "saltus/solver/detail/dopri5.hpp"
#include "saltus/solver/detail/hardly_damped.hpp"
#include "saltus/solver/detail/progress.hpp"
#include "saltus/solver/detail/runge_kutta.hpp"
#include "saltus/solver/detail/spectral_radius.hpp"
#include "saltus/solver/detail/step_size.hpp"
#include "saltus/solver/detail/step_solver.hpp"
#include "sundials_compat.hpp"

namespace saltus {

extern template class RungeKutta<Dopri5>;  // dopri5_solver.cpp

namespace {

class CvodeSolver final : public StepSolver<CvodeSolver> {
 public:
  CvodeSolver(Machine& machine, GuardSet& guards, const SolverOptions& options, CvodeMethod method)
      : StepSolver(machine, guards, options),
        method_(method),
        tolerances_(tolerances_for(method, options)),
        context_(sun::make_context()),
        y_(make_vector(n_, context_.get())),
        dky_(N_VClone(y_.get())),
        x0_(n_),
        scene_(machine, guards),
        cvode_(CVodeCreate(method == CvodeMethod::adams ? CV_ADAMS : CV_BDF, context_.get())),
        starter_{RungeKutta<Dopri5>(machine, guards, without_first_step(options))},
        radius_(machine, options) {
    if (!cvode_ || !y_ || !dky_) throw Error("SUNDIALS: out of memory");
    hook_ = {
        [](const char* message, void* self) { static_cast<CvodeSolver*>(self)->note(message); },
        this};
    sun::hook_errors(context_.get(), cvode_.get(), &hook_);
    if (method_ == CvodeMethod::bdf) starter_.method.watch_stiffness();
  }

  void inside_step(double u, double* x) {
    if (starter_.runs) return starter_.method.inside_step(u, x);
    if (CVodeGetDky(cvode_.get(), t0_ + u, 0, dky_.get()) < 0) fail(t0_ + u);
    std::copy_n(N_VGetArrayPointer(dky_.get()), n_, x);
  }

  const SolverStatistics& statistics() const override {
    sum_ = statistics_;
    add_counts(sum_);
    sum_.linear_solver = scene_.describe_linear();
    return sum_;
  }

  int degree() const override {
    if (starter_.runs) return starter_.method.degree();
    int order = 0;
    CVodeGetLastOrder(cvode_.get(), &order);
    return order;
  }

  std::string name() const override { return method_ == CvodeMethod::adams ? "adams" : "bdf"; }
  std::string method() const override {
    if (!doubt_.is_sure()) return name();
    return text(name(), "; ", doubt_.words());
  }

 private:
  friend StepSolver<CvodeSolver>;

  void begin(const Start& how) {
    if (how.first) first_step_ = 0.0, progress_.begin(), doubt_.begin();
    last_message_.clear();
    x0_at_ = std::numeric_limits<double>::quiet_NaN();
    scene_.begin_at(t1_);
    // A one-step method starts if an event may follow soon, and CVODE continues if the flight is
    // longer.
    if (cvode::is_event_near(how.horizon, first_step_))
      start_with_one_step(t1_, x1_, how.horizon);
    else
      start_cvode(how.first);
  }

  /// The starter begins stretches inside a run.
  static SolverOptions without_first_step(SolverOptions options) {
    options.first_step = 0.0;
    return options;
  }

  void start_with_one_step(double t, const Eigen::VectorXd& x, double horizon) {
    starter_.runs = true;
    starter_.until = cvode::start_ends(t, horizon);
    starter_.method.begin_at(t, x, {.horizon = horizon, .first = true});
  }

  void start_cvode(bool first = false) {
    starter_.runs = false;
    steps_ = 0;
    std::copy_n(x1_.data(), n_, N_VGetArrayPointer(y_.get()));
    if (!started_) {
      create();
    } else {
      if (!first) add_counts(statistics_);
      if (CVodeReInit(cvode_.get(), t1_, y_.get()) < 0) fail(t1_);
    }
    if (options_.first_step > 0.0)
      CVodeSetInitStep(cvode_.get(), first ? options_.first_step : 0.0);
    scene_.aim(cvode_.get());
  }

  /// Without CVODE's detection of the stability limit (CVodeSetStabLimDet). It helps on B5 of
  /// DETEST, modes of -10 +- 100i (1195 calls in place of 6255 at rtol 1e-4), and changes nothing
  /// on the shelf. But it also lowers the order where the solution itself oscillates: a mode of -2
  /// +- 2000i that dies away takes 3.6 times the calls at rtol 1e-8, and errors are 500 times
  /// larger.
  void create() {
    void* cvode = cvode_.get();
    if (CVodeInit(cvode, CvodeScene::right_hand_side, t1_, y_.get()) < 0) fail(t1_);
    CVodeSetUserData(cvode, &scene_);
    set_tolerances(cvode, y_.get(), scene_, tolerances_);
    set_limits(cvode, options_);
    if (method_ == CvodeMethod::adams) {
      nonlinear_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_.get()));
      CVodeSetNonlinearSolver(cvode, nonlinear_.get());
      corrector_.attach(nonlinear_.get());
    } else {
      if (is_loose(method_, options_)) CVodeSetNonlinConvCoef(cvode, thresholds::loose_newton);
      scene_.make_linear(options_, t1_, x1_.data());
      scene_.attach_linear(cvode, y_.get(), context_.get());
    }
    scene_.watch_guards(cvode);
    started_ = true;
  }

  void undo() { t1_ = t0_, x1_ = x0_; }

  /// The guards at the end of the step, where CVODE has just looked at them.
  const double* end_guards() const { return starter_.runs ? nullptr : scene_.guards_at(t1_); }

  void step(double t_stop) {
    // Steps within a rounding of the time add up to none: the first state at a time is the one that
    // a failure leaves, as in the rows.
    if (t1_ != x0_at_) x0_ = x1_, x0_at_ = t1_;
    if (starter_.runs && (t1_ >= starter_.until || flight_is_stiff())) start_cvode();
    // CVODE takes no step within a few roundings of the time.
    const double latest = std::isfinite(t_stop) ? std::abs(t_stop) : 0.0;
    const double shortest = cvode::shortest_step(std::max(latest, std::abs(t1_)));
    if (!starter_.runs && t_stop - t1_ < shortest) {
      start_with_one_step(t1_, x1_, t_stop - t1_);
      starter_.until = t_stop;
    }
    if (!starter_.runs) cvode_step(t_stop);
    if (!starter_.runs) return;
    starter_.method.bare_step(t_stop);
    ++statistics_.steps;
    t1_ = starter_.method.step_end(), length_ = starter_.method.step_length(),
    x1_ = starter_.method.step_state();
  }

  /// Whether the rest of the starter's flight is long for an explicit method. The rate is 0, and
  /// the answer no, before its first step and with Adams.
  bool flight_is_stiff() {
    return cvode::is_flight_stiff(starter_.method.stiffness().rate(), starter_.until - t1_);
  }

  /// Whether CVODE's own step, in which it found a root, ends beyond a stop that this root has set.
  bool is_beyond(double t_stop) const {
    double t = t1_;
    return CVodeGetCurrentTime(cvode_.get(), &t) >= 0 && t > t_stop;
  }

  /// CVODE takes the scale of its first step from the end, as first_step does.
  double end_for_scale(double t_stop) const {
    return std::isfinite(t_stop) ? t_stop : t0_ + std::max(1.0, std::abs(t0_));
  }

  void cvode_step(double t_stop) {
    if (is_beyond(t_stop)) start_cvode();
    if (CVodeSetStopTime(cvode_.get(), t_stop) < 0) fail(t0_);
    double t = t0_;
    const int flag = CVode(cvode_.get(), end_for_scale(t_stop), y_.get(), &t, CV_ONE_STEP);
    scene_.rethrow();
    if (flag < 0 && scene_.renew_linear(flag)) {
      last_message_.clear();
      scene_.attach_linear(cvode_.get(), y_.get(), context_.get());
      start_cvode();
      return cvode_step(t_stop);
    }
    if (flag == CV_REPTD_RHSFUNC_ERR && steps_ == 0) return start_at_edge(t_stop);
    if (flag < 0) fail(t);
    if (steps_ == 0) CVodeGetActualInitStep(cvode_.get(), &first_step_);
    if (flag == CV_ROOT_RETURN && too_coarse()) {
      start_with_one_step(t0_, x1_, first_step_);
      return;
    }
    accept(flag == CV_TSTOP_RETURN ? t_stop : t);
  }

  /// CVODE's step to t is taken.
  void accept(double t) {
    ++steps_;
    t1_ = t;
    length_ = t1_ - t0_;
    if (progress_.stops_at(t0_, length_, N_VGetArrayPointer(y_.get()), n_))
      throw_step_too_small(*machine_, t0_, length_, x1_.data(), options_);
    std::copy_n(N_VGetArrayPointer(y_.get()), n_, x1_.data());
    if (doubt_.is_due()) doubt();
  }

  /// CVODE found no first step within its four tries: the edge of what f is defined for is near. The
  /// one-step method shortens its steps as far as it has to.
  void start_at_edge(double t_stop) {
    last_message_.clear();
    start_with_one_step(t1_, x1_, t_stop - t1_);
    starter_.until = t_stop;
  }

  /// Looks at the fastest part of the scene. The look leaves the trajectory: where a callback
  /// raises an exception there, nothing is noted.
  void doubt() {
    try {
      radius_.forget();
      const double rate = radius_(t1_, x1_);
      doubt_.note(may_add_up(rate, radius_.damping()), rate);
    } catch (const Interruption&) {
      throw;
    } catch (...) {
      detail::pass_end_of_thread();
    }
  }
  bool may_add_up(double rate, double damping) const {
    return method_ == CvodeMethod::bdf
               ? cvode::bdf_amplifies(degree(), length_ * rate, damping)
               : cvode::adams_is_bounded(failed_corrections() / steps_, damping);
  }
  /// Steps that the convergence of the corrector has shortened since CVODE's start.
  double failed_corrections() const {
    long failed = 0;
    CVodeGetNumNonlinSolvConvFails(cvode_.get(), &failed);
    return static_cast<double>(failed);
  }

  /// Whether a guard that was at zero when this stretch began may have a false root.
  bool too_coarse() const {
    return cvode::is_coarse(steps_) && std::ranges::any_of(guards_->all(), [](const Guard& guard) {
             return guard.active && guard.at_zero() && !guard.monitor;
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

  void note(const char* message) {
    if (last_message_.empty()) last_message_ = message;
  }

  [[noreturn]] void fail(double t) {
    scene_.rethrow();
    double h = 0.0;
    CVodeGetCurrentTime(cvode_.get(), &t);
    CVodeGetCurrentStep(cvode_.get(), &h);
    require_finite_near(*machine_, t, h, x1_.data());
    if (options_.min_step > 0.0) throw_step_too_small(*machine_, t, h, x1_.data(), options_);
    const std::string block = fastest_block(*machine_, t, x1_.data(), options_);
    throw SimulationError(
        text("t = ", t, " s: CVODE (", name(), ") cannot go on, step ", h, " s: ", last_message_,
             "; the solution blows up in finite time, has a jump that no guard announces, or the "
             "tolerance cannot be met; block '",
             block, "' moves fastest; ", words_of_tolerances(options_)),
        t, block);
  }

  CvodeMethod method_;
  SolverOptions tolerances_;  // those of CVODE
  sun::ErrorHook hook_;
  std::string last_message_;
  sun::Context context_;
  sun::Vector y_, dky_;
  sun::Nonlinear nonlinear_;
  Eigen::VectorXd x0_;        // the state before the step
  double x0_at_ = 0.0;        // [s]
  sun::Corrector corrector_;  // CVODE keeps its address
  CvodeScene scene_;          // it needs the context, and CVODE needs it
  sun::Cvode cvode_;
  /// A one-step method that begins stretches in which an event may follow soon.
  struct Starter {
    RungeKutta<Dopri5> method;
    bool runs = false;
    double until = 0.0;  // [s]
  } starter_;
  bool started_ = false;
  double first_step_ = 0.0;
  int steps_ = 0;  // CVODE's steps since its start
  Progress progress_;
  cvode::Doubt doubt_;
  SpectralRadius radius_;
  mutable SolverStatistics sum_;
};

}  // namespace

std::unique_ptr<Solver> make_cvode(Machine& machine, GuardSet& guards, const SolverOptions& options,
                                   CvodeMethod method) {
  return std::make_unique<CvodeSolver>(machine, guards, options, method);
}

}  // namespace saltus
