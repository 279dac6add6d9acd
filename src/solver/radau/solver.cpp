// The stepper of the Radau methods: Newton's iteration, error estimate, length and order of steps.
#include <optional>
#include <utility>

#include "newton.hpp"
#include "saltus/solver/detail/radau.hpp"
#include "saltus/solver/detail/step_size.hpp"
#include "saltus/solver/detail/step_solver.hpp"
#include "saltus/solver/detail/thresholds.hpp"
#include "step_control.hpp"

namespace saltus::radau {

namespace {

class RadauSolver final : public StepSolver<RadauSolver> {
 public:
  RadauSolver(Machine& machine, GuardSet& guards, const SolverOptions& options)
      : StepSolver(machine, guards, options),
        x0_(n_),
        f0_(n_),
        residual_(n_),
        scratch_(n_),
        middle_(n_),
        shift_(n_),
        newton_(machine, options),
        step_(n_),
        last_(n_),
        first_half_(n_),
        second_half_(n_) {}

  void inside_step(double u, double* x) {
    if (!looked_) look_inside();
    const double s = u / length_;
    if (!halved_) return step_.read(x0_.data(), s, x);
    if (s < 0.5)
      first_half_.read(x0_.data(), 2.0 * s, x);
    else
      second_half_.read(middle_.data(), 2.0 * s - 1.0, x);
    for (Index i = 0; i < n_; ++i) x[i] += s * shift_[i];
  }

  int degree() const override { return step_.stages; }
  double joint() override {
    if (!looked_) look_inside();
    return halved_ ? t0_ + 0.5 * length_ : -std::numeric_limits<double>::infinity();
  }
  std::string method() const override { return "radau"; }
  const SolverStatistics& statistics() const override {
    sum_ = statistics_;
    if (structure_) sum_.linear_solver = structure_->describe();
    return sum_;
  }

  /// See StepSolver. The root is off by the error of the dense output, and the cut ends ten times as
  /// far beyond it. Near the begin of the step the polynomial is as good as the state there.
  bool cut(double root) {
    const double moved = in_tolerances(x1_ - x0_);
    const double off = step_error_ * scheme_of(step_.stages).dense_share / std::max(moved, 1e-300);
    const double h = root * (1.0 + std::clamp(10.0 * off, 1e-12, 1e-2));
    if (!(h < length_ && root > near_begin * length_)) return false;
    last_ = step_;
    last_.predict(step_.stages, 0.0, h / length_, step_.z);
    if (!solve_aside(t0_, h, x0_, step_)) {
      std::swap(step_, last_);
      return false;
    }
    t1_ = t0_ + h;
    finish_stages(h);
    return true;
  }

 private:
  friend StepSolver<RadauSolver>;
  /// [of the step] The error of the collocation polynomial has the factor s; so near its begin it is a
  /// thousandth of its largest.
  static constexpr double near_begin = 1e-3;
  /// [steps] The polynomial of the last step predicts no more than this.
  static constexpr double furthest = 16.0;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  void begin(const Start& start) {
    if (start.first || start.handover) {
      h_ = start.first ? options_.first_step : 0.0;
      step_.stages = stage_counts.front();
      structure_.reset(), systems_.reset(), aside_.reset();
    }
    f_known_ = start.flow != nullptr;
    if (f_known_) f0_ = *start.flow;
    horizon_ = start.horizon;
    control_.forget();
    smooth_ = false;
    newton_factor_ = infinite;
    order_ = {.stages = step_.stages};
  }

  void undo() {
    x1_ = x0_, t1_ = t0_;
    smooth_ = f_known_ = false;
    newton_factor_ = infinite;
  }

  /// Tries steps until one is accepted.
  void step(double t_stop) {
    prepare_step(t_stop);
    double wish = std::min({h_, options_.max_step, std::exchange(horizon_, infinite)});
    const double left = t_stop - t0_;
    for (bool rejected = false;; rejected = true) {
      const bool ends = wish >= left;
      const double h = ends ? left : 2.0 * wish > left ? 0.5 * left : wish;
      if (!ends) require_room(h);
      t1_ = ends ? t_stop : t0_ + h;
      if (!solve(h)) {
        if (creep(h)) return;
        wish = h * shorter_;
        order_.newton_failed = true;
        choose_order(1.0);
        continue;
      }
      const double error = estimate(h) / allowed_;
      if (error <= 1.0) return accept(error, h, wish, rejected);
      ++statistics_.rejected;
      wish = PredictiveControl::reject(error, h, scheme().estimate_order(), safety());
    }
  }

  Scheme scheme() const { return scheme_of(step_.stages); }

  void prepare_step(double t_stop) {
    x0_.swap(x1_);
    last_length_ = length_;
    std::swap(step_, last_);
    step_.stages = order_.stages;
    if (!f_known_) machine_->derivative(t0_, x0_.data(), f0_.data());
    f_known_ = false;
    if (!f0_.allFinite()) throw_not_finite(*machine_, t0_, x0_.data());
    if (!structure_) make_structure();
    allowed_ = allowed_estimate(scheme(), options_.rtol, thresholds::dense_room);
    if (h_ == 0.0)
      h_ = first_step(*machine_, t0_, x0_, f0_.data(), scratch_, residual_.data(), options_,
                      scheme().estimate_order(), t_stop);
    h_ = std::max(h_, options_.min_step);
  }

  void make_structure() {
    structure_.emplace(*machine_, options_, t0_, x0_.data());
    if (!structure_->direct()) refuse_matrix_free();
    use_structure();
  }
  void use_structure() {
    systems_.emplace(*structure_), aside_.emplace(*structure_);
    jacobian_.assign(static_cast<std::size_t>(structure_->layout().size), 0.0);
    jacobian_known_ = false;
  }

  /// Solves the stages of a step of length h, with a new Jacobian if the old one does not serve.
  /// False if Newton's iteration does not converge: `shorter_` then is a factor for h.
  bool solve(double h) {
    shorter_ = 0.5;
    for (;;) {
      if (!jacobian_known_ && !make_jacobian(h)) return false;
      if (!systems_->serves(scheme(), h) && !factor(*systems_, h)) return false;
      start_stages(h);
      const Verdict verdict =
          newton_.solve({t0_, h, x0_.data(), newton_room(), newton_factor_}, *systems_, step_);
      if (verdict == Verdict::converged) return true;
      newton_factor_ = infinite;
      if (jacobian_age_ == 0) {
        if (structure_->renew(true)) {
          use_structure();
          continue;
        }
        if (verdict == Verdict::slow) shorter_ = newton_.convergence().shorter();
        if (!newton_.finite()) shorter_ = 0.1;
        return false;
      }
      jacobian_known_ = false;
    }
  }

  /// Takes the step along the derivative if no state moves by a tolerance in it, and the derivative
  /// jumps: there Newton's iteration may not converge, however short the step is. Without steps a
  /// solution that slides along a jump would not be noticed.
  bool creep(double h) {
    for (int j = 0; j < step_.stages; ++j) step_.z.col(j) = scheme().c[j] * h * f0_;
    finish_stages(h);
    step_error_ = in_tolerances(step_.z.col(step_.stages - 1));
    if (!(step_error_ <= 0.5)) return false;
    machine_->derivative(t1_, x1_.data(), residual_.data());
    if (!((residual_ - f0_).norm() > 0.1 * f0_.norm())) return false;
    ++statistics_.steps;
    h_ = h, smooth_ = jacobian_known_ = false;
    return true;
  }

  /// [tolerances] What Newton's iteration may leave.
  double newton_room() const { return std::max(0.05, 10.0 * thresholds::eps / options_.rtol); }

  bool make_jacobian(double h) {
    const Increments by = structure_->increments(h);
    for (;;) {
      if (!structure_->jacobian()(t0_, x0_.data(), f0_.data(), by, jacobian_.data())) return false;
      if (!structure_->misses_places(t0_, x0_.data(), f0_.data(), by, jacobian_.data())) break;
      structure_->renew(false);
      use_structure();
    }
    systems_->forget(), aside_->forget();
    jacobian_known_ = true, jacobian_age_ = 0;
    return true;
  }

  bool factor(StageSystems& systems, double h) {
    ++statistics_.linear_setups;
    return systems.factor(jacobian_, scheme(), h);
  }

  void start_stages(double h) {
    const double ratio = h / last_length_;
    if (smooth_ && ratio < furthest)
      last_.predict(step_.stages, 1.0, ratio, step_.z);
    else
      step_.z.leftCols(step_.stages).setZero();
  }

  /// Root mean square of the error estimate [tolerances] (Hairer, Wanner II, IV.8, (8.19)). It is not
  /// filtered a second time where it is large at a start, as (8.20) does: a transient that is damped
  /// within the step leaves no error at its end, but the collocation polynomial is wrong inside.
  double estimate(double h) {
    finish_stages(h);
    const Scheme m = scheme();
    residual_ = h * f0_;
    for (int j = 0; j < m.stages; ++j) residual_ += m.e[j] * step_.z.col(j);
    systems_->solve_real(residual_.data());
    step_error_ = in_tolerances(residual_);
    return std::isfinite(step_error_) ? step_error_ : infinite;
  }

  void finish_stages(double h) {
    length_ = h;
    x1_ = x0_ + step_.z.col(step_.stages - 1);
    looked_ = halved_ = false;
  }

  template <class Vector>
  double in_tolerances(const Vector& v) const {
    double sum = 0.0;
    for (Index i = 0; i < n_; ++i) {
      const double e = v[i] / options_.tolerance(i, std::max(std::abs(x0_[i]), std::abs(x1_[i])));
      sum += e * e;
    }
    return std::sqrt(sum / static_cast<double>(n_));
  }

  double safety() const {
    const int most = 7 + 5 * (step_.stages - 3) / 2;
    return 0.9 * (1.0 + 2.0 * most) / (newton_.convergence().iterations() + 2.0 * most);
  }

  void accept(double error, double h, double wish, bool rejected) {
    ++statistics_.steps;
    const Convergence& newton = newton_.convergence();
    newton_factor_ = newton.factor();
    if (newton.iterations() > 1) order_.theta = std::max(newton.theta(), 0.5 * order_.theta);
    const double next =
        control_.accept(error, h, scheme().estimate_order(), safety(), rejected);
    ++jacobian_age_, ++order_.steps;
    const bool contracts = newton.iterations() <= 2 || newton.theta() <= 1e-3;
    if (!contracts || (n_ <= thresholds::fresh_jacobian && jacobian_age_ >= 20))
      jacobian_known_ = false;
    choose_order(smooth_ ? h / last_length_ : 0.0);
    // A factorisation costs more than a step that is a little longer saves.
    const bool keeps = jacobian_known_ && order_.stages == step_.stages && next >= h && next < 1.2 * h;
    h_ = keeps ? h : next;
    if (!rejected && h < wish) h_ = std::max(h_, wish);
    smooth_ = true;
  }

  /// Chooses the stages of the next step; `ratio` of the lengths of the last two steps.
  void choose_order(double ratio) {
    order_.ratio = ratio;
    const int stages = next_stages(order_);
    order_.newton_failed = false;
    if (stages == order_.stages) return;
    order_ = {.stages = stages};
    control_.forget();
  }

  // --- inside a step

  /// Takes the step again in two halves if the collocation polynomial is not good enough for looks
  /// inside.
  void look_inside() {
    looked_ = true;
    halved_ = step_error_ * scheme().dense_share > thresholds::dense_room && halve();
  }
  bool halve() {
    const double h = 0.5 * length_;
    first_half_.stages = second_half_.stages = step_.stages;
    step_.predict(step_.stages, 0.0, 0.5, first_half_.z);
    if (!solve_aside(t0_, h, x0_, first_half_)) return false;
    middle_ = x0_ + first_half_.z.col(step_.stages - 1);
    step_.predict(step_.stages, 0.5, 0.5, second_half_.z);
    if (!solve_aside(t0_ + h, h, middle_, second_half_)) return false;
    shift_ = x1_ - middle_ - second_half_.z.col(step_.stages - 1);
    return shift_.allFinite();
  }
  /// Solves the stages of a part of the last step.
  bool solve_aside(double t, double h, const Eigen::VectorXd& x, StagePolynomial& stages) {
    if (!aside_->serves(scheme_of(stages.stages), h) &&
        (++statistics_.linear_setups, !aside_->factor(jacobian_, scheme_of(stages.stages), h)))
      return false;
    return newton_.solve({t, h, x.data(), newton_room(), infinite}, *aside_, stages) ==
           Verdict::converged;
  }

  // --- when no step is small enough

  void require_room(double h) {
    const double smallest = thresholds::least_step_roundings * thresholds::eps * std::abs(t0_);
    if (h > smallest && h >= options_.min_step) return;
    throw_step_too_small(*machine_, t0_, h, x0_.data(), options_);
  }

  [[noreturn]] void refuse_matrix_free() const {
    throw SimulationError(
        text("t = ", t0_, " s: ode_solver_method 'radau' solves its linear systems by factorisation, "
             "and the Jacobian of this scene is too full for that (", structure_->describe(),
             "); take 'bdf', declare the sparsity of the largest block, or set linear_solver = "
             "'sparse', 'band' or 'dense'"),
        t0_, "");
  }

  Eigen::VectorXd x0_, f0_;  // at the begin of the step
  Eigen::VectorXd residual_, scratch_;
  Eigen::VectorXd middle_, shift_;
  Newton newton_;
  std::optional<LinearStructure> structure_;
  std::optional<StageSystems> systems_, aside_;
  std::vector<double> jacobian_;
  bool jacobian_known_ = false;
  int jacobian_age_ = 0;  // [steps]
  StagePolynomial step_, last_;
  StagePolynomial first_half_, second_half_;
  bool looked_ = false, halved_ = false;
  bool f_known_ = false;
  bool smooth_ = false;  // the last step continues in the present one
  double h_ = 0.0, horizon_ = infinite, last_length_ = 0.0;
  double step_error_ = 0.0, allowed_ = 1.0, shorter_ = 0.5;
  double newton_factor_ = infinite;
  PredictiveControl control_;
  OrderFacts order_;
  mutable SolverStatistics sum_;
};

}  // namespace

}  // namespace saltus::radau

namespace saltus {

std::unique_ptr<Solver> make_radau(Machine& machine, GuardSet& guards,
                                   const SolverOptions& options) {
  return std::make_unique<radau::RadauSolver>(machine, guards, options);
}

}  // namespace saltus
