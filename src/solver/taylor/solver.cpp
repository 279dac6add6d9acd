// The stepper of the Taylor method: order and length of steps, their check, looks inside them.
#include <array>
#include <memory>
#include <utility>

#include "expansion.hpp"
#include "guard_series.hpp"
#include "saltus/plan/detail/flow_series.hpp"
#include "saltus/solver/detail/dop853.hpp"
#include "saltus/solver/detail/runge_kutta.hpp"
#include "saltus/solver/detail/step_size.hpp"
#include "saltus/solver/detail/step_solver.hpp"
#include "saltus/solver/detail/taylor.hpp"
#include "saltus/solver/detail/taylor/step_rule.hpp"
#include "saltus/solver/detail/taylor/tuning.hpp"

namespace saltus::taylor {

namespace {

/// The series of a plan; throws a ModelError if there is none.
std::shared_ptr<const FlowSeries> series_of(const Plan& plan) {
  auto found = flow_series(plan);
  if (found->series) return found;
  throw ModelError(text("ode_solver_method 'taylor': ", found->obstacle,
                        "; or take the method 'auto' or 'dop853'"));
}

class TaylorSolver final : public StepSolver<TaylorSolver> {
 public:
  TaylorSolver(Machine& machine, GuardSet& guards, const SolverOptions& options)
      : StepSolver(machine, guards, options),
        guard_series_(guards),
        x0_(n_),
        rest0_(Eigen::VectorXd::Zero(n_)),
        rest1_(Eigen::VectorXd::Zero(n_)),
        change_(n_),
        slope_(n_),
        f1_(n_) {
    make_series();
  }

  void inside_step(double u, double* x) {
    if (fallen_back_) return other_->inside_step(u, x);
    expansion_->state(u, x0_.data(), rest0_.data(), x);
  }
  std::string method() const override {
    if (others_ == 0) return "taylor";
    return text("taylor: ", others_, " of ", statistics_.steps, " steps by dop853");
  }
  int degree() const override { return fallen_back_ ? other_->degree() : expansion_->order(); }
  /// A step of a series is up to three times as long as one of dop853.
  int even_looks() const { return fallen_back_ ? degree() : 3 * degree(); }
  double joint() override { return fallen_back_ ? other_->joint() : -infinite; }
  LookPoints* look_points() { return &guard_series_; }

 private:
  friend StepSolver<TaylorSolver>;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  void make_series() {
    const auto kept = series_of(machine_->plan());
    hides_ = kept->hides;
    guard_series_.take(kept);
    expansion_ = std::make_unique<Expansion>(*machine_, *kept->series, order_of(options_.rtol));
    functions_ = machine_->functions();
  }

  void begin(const Start& start) {
    rest1_.setZero();
    horizon_ = start.horizon;
    first_ = start.first ? options_.first_step : 0.0;
    if (start.first) longest_ = 0.0, others_ = 0;
    fallen_back_ = false;
  }
  void undo() { x1_ = x0_, t1_ = t0_, rest1_ = rest0_, fallen_back_ = false; }

  void step(double t_stop) {
    if (functions_ != machine_->functions()) make_series();
    x0_.swap(x1_), rest0_.swap(rest1_);
    guard_series_.begin_step(nullptr, 0, 0.0);
    if (machine_->carries() || !expansion_->at(t0_, x0_.data())) return fall_back(t_stop);
    fallen_back_ = false;
    const double asked = std::max(first_wish(t_stop), options_.min_step);  // only a guess
    double wish = std::min({asked, options_.max_step, std::exchange(horizon_, infinite)});
    const double left = t_stop - t0_;
    for (;;) {
      const auto [h, ends] = fit(wish, left);
      if (!ends && !has_room(t0_, h, options_))
        throw_step_too_small(*machine_, t0_, h, x0_.data(), options_);
      t1_ = ends ? t_stop : t0_ + h;
      length_ = t1_ - t0_;
      const double error = end_of_step();
      if (error <= 1.0) break;
      ++statistics_.rejected;
      wish = h * shorter(error, expansion_->order());
    }
    ++statistics_.steps;
    longest_ = std::max(longest_, length_);
    guard_series_.begin_step(&expansion_->series(), expansion_->order(), length_);
  }

  /// The length that the series asks for.
  double first_wish(double t_stop) {
    const double given = std::exchange(first_, 0.0);
    if (given > 0.0) return given;
    const double h = length_of(expansion_->order(), [&](int k) {
      return largest_term(n_, expansion_->row(k), [&](Index i) { return tolerance(i, x0_); });
    });
    const bool bounded = std::isfinite(h) || std::isfinite(t_stop);
    if (bounded && !hides_) return h;
    return std::min(h, longest_ > 0.0 ? tuning::hidden_growth * longest_ : short_step(t_stop));
  }
  /// The first step of a run for which the series sets no bound, or may hide one.
  double short_step(double t_stop) {
    return saltus::first_step(*machine_, t0_, x0_, expansion_->row(1), slope_, f1_.data(), options_,
                              expansion_->order(), t_stop);
  }
  double tolerance(Index i, const Eigen::VectorXd& x) const {
    return options_.tolerance(i, std::abs(x[i]));
  }

  /// Computes x1 with the rounding error that is carried to the next step, and returns the error of
  /// the step in tolerances, as the end of the step shows it; also as its inside shows it, where
  /// the series may hide something.
  double end_of_step() {
    for (int j = 1; hides_ && j < tuning::hidden_looks; ++j) {
      const double error =
          error_at(length_ * j / tuning::hidden_looks, t0_ + length_ * j / tuning::hidden_looks);
      if (!(error <= 1.0)) return error;
    }
    const double error = error_at(length_, t1_);
    for (Index i = 0; i < n_; ++i) {
      const double change = change_[i] + rest0_[i];
      const double kept = x1_[i] - x0_[i];  // TwoSum (D. E. Knuth, TAOCP 2, 4.2.2, theorem C)
      rest1_[i] = (x0_[i] - (x1_[i] - kept)) + (change - kept);
    }
    return error;
  }
  /// Sets x1 to the state at offset u, and compares the slope of the series with f there. The
  /// series leaves out x^[p+1] h^(p+1), so that its slope at the end differs from f by (p + 1) / h
  /// times that. This costs one call, and also sees what no coefficient shows.
  double error_at(double u, double t) {
    expansion_->change_and_slope(u, change_.data(), slope_.data());
    for (Index i = 0; i < n_; ++i) x1_[i] = x0_[i] + (change_[i] + rest0_[i]);
    machine_->derivative(t, x1_.data(), f1_.data());
    double largest = 0.0;
    for (Index i = 0; i < n_; ++i) {
      const double size = std::max(std::abs(x0_[i]), std::abs(x1_[i]));
      const double off = std::abs(slope_[i] - f1_[i]) / options_.tolerance(i, size);
      if (!(off <= largest)) largest = std::isfinite(off) ? off : infinite;
    }
    return largest * length_ / (expansion_->order() + 1);
  }

  /// Takes the step with dop853: a block is carried with a surface, or the solution has no series
  /// at this point, as sqrt(x) has none at zero.
  void fall_back(double t_stop) {
    if (other_ == nullptr)
      other_ = std::make_unique<RungeKutta<Dop853>>(*machine_, *guards_, options_);
    if (!fallen_back_)
      other_->begin_at(t0_, x0_, {.horizon = std::exchange(horizon_, infinite), .first = true});
    other_->bare_step(t_stop);
    t1_ = other_->step_end(), length_ = other_->step_length(), x1_ = other_->step_state();
    rest1_.setZero();
    fallen_back_ = true;
    ++statistics_.steps, ++others_;
  }

  GuardSeries guard_series_;
  std::unique_ptr<Expansion> expansion_;
  std::unique_ptr<RungeKutta<Dop853>> other_;  // made when it is first needed
  bool fallen_back_ = false;                   // it took the last step
  std::int64_t others_ = 0;                    // steps that it took in this run
  bool hides_ = false;                         // see FlowSeries
  Eigen::VectorXd x0_;
  Eigen::VectorXd rest0_, rest1_;        // what rounding has cut off x0 and x1
  Eigen::VectorXd change_, slope_, f1_;  // at the end of the step
  int functions_ = 0;                    // of the machine, of which the series is made
  double first_ = 0.0;                   // [s] the first step that the user asks for; 0: none
  double longest_ = 0.0;                 // [s] step of this run
  double horizon_ = infinite;
};

}  // namespace

}  // namespace saltus::taylor

namespace saltus {

std::unique_ptr<Solver> make_taylor(Machine& machine, GuardSet& guards,
                                    const SolverOptions& options) {
  return std::make_unique<taylor::TaylorSolver>(machine, guards, options);
}

void require_taylor_series(const Plan& plan) { taylor::series_of(plan); }

}  // namespace saltus
