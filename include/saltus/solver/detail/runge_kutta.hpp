// One-step method of explicit Runge-Kutta type with dense output and location on it. It has no
// history: a restart after a reset costs one evaluation of the right-hand side.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "saltus/solver/detail/explicit_step.hpp"
#include "saltus/solver/detail/halves.hpp"
#include "saltus/solver/detail/kernels.hpp"
#include "saltus/solver/detail/one_step.hpp"
#include "saltus/solver/detail/step_size.hpp"
#include "saltus/solver/detail/step_solver.hpp"
#include "saltus/solver/detail/stiffness.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// The stepper. N is the number of states, or 0 if it is known at run time only.
template <Tableau Method, int N = 0>
class RungeKutta final : public StepSolver<RungeKutta<Method, N>, OneStepSolver> {
 public:
  RungeKutta(Machine& machine, GuardSet& guards, const SolverOptions& options)
      : Base(machine, guards, options),
        x0_(n_),
        scratch_(n_),
        k_(n_),
        dense_(n_),
        halves_(n_),
        stiff_({Method::stability, Method::imaginary, Method::amplitude}, static_cast<double>(last),
               options) {}

  void inside_step(double u, double* x) {
    if (!dense_ready_) prepare_dense();
    if constexpr (checks_dense) {
      if (halves_.used) return halves_.read(x0_.data(), u / length_, x);
    }
    dense_.read(x0_.data(), u / length_, x);
  }

  std::string method() const override { return Method::name; }
  int degree() const override { return static_cast<int>(StepPolynomial<Method, N>::terms); }
  double joint() override {
    if constexpr (checks_dense) {
      if (!dense_ready_) prepare_dense();
      if (halves_.used) return t0_ + 0.5 * length_;
    }
    return -infinite;
  }

  /// The two halves of a step have overwritten its stages.
  StepStages stages() override {
    if (this->is_tangent()) return {};
    if constexpr (checks_dense)
      if (dense_ready_ && halves_.used) return {};
    return {make_column_steps<Method>,
            t0_,
            t1_,
            length_,
            x0_.data(),
            x1_.data(),
            k_.data(),
            dense_ready_};
  }

  void watch_stiffness() override { watches_stiffness_ = true; }
  StiffnessTest& stiffness() override { return stiff_; }
  double stability() const override { return Method::stability; }

 private:
  using Base = StepSolver<RungeKutta<Method, N>, OneStepSolver>;
  static constexpr int W = detail::called_width<N>;
  using Lane = detail::Lane<W>;
  friend Base;
  using Base::machine_, Base::options_, Base::n_, Base::t0_, Base::t1_, Base::length_, Base::x1_,
      Base::statistics_;
  static constexpr std::size_t last = Method::stages - 1;
  static constexpr bool checks_dense = ChecksDense<Method>;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  static StepController controller() {
    return {Method::error_order, Method::beta, Method::shortest, Method::longest};
  }
  Index size() const { return detail::count<N>(n_); }
  VectorView view(const double* x) const { return {x, size()}; }
  double* stage(std::size_t i) { return k_.data() + static_cast<Index>(i) * size(); }

  /// Whether xdot was 0 at the end of the last step. Steps grow without limit then, and say nothing of
  /// a flow that begins to move.
  bool was_at_rest() { return (view(stage(last)).array() == 0.0).all(); }

  void begin(const Start& start) {
    if (start.first || start.changed || was_at_rest()) {
      h_ = start.first ? options_.first_step : 0.0;
      controller_ = controller();
    }
    if (start.flow != nullptr)
      std::copy_n(start.flow->data(), size(), stage(last));
    else
      machine_->derivative(t1_, x1_.data(), stage(last));
    dense_ready_ = false;
    horizon_ = start.horizon;
    stiff_.forget(start.first);
  }

  void undo() { x1_ = x0_, t1_ = t0_; }

  /// Tries steps until one is accepted.
  void step(double t_stop) {
    x0_.swap(x1_);
    std::copy_n(stage(last), size(), stage(0));
    dense_ready_ = false;
    require_finite_start();
    if (h_ == 0.0)
      h_ = first_step(*machine_, t0_, x0_, stage(0), scratch_, stage(1), options_,
                      Method::error_order, t_stop);
    h_ = std::max(h_, options_.min_step);  // the first step is only a guess
    double wish = std::min({h_, options_.max_step, std::exchange(horizon_, infinite)});
    const double left = t_stop - t0_;
    for (bool rejected = false;; rejected = true) {
      const auto [h, ends] = fit(wish, left);
      if (!ends) require_room(h);
      const double error = try_step(h, ends ? t_stop : t0_ + h);
      if (error <= 1.0) {
        ++statistics_.steps;
        length_ = h;
        h_ = controller_.accept(error, h, rejected);
        if (!rejected && h < wish)
          h_ = std::max(h_, wish);  // the stop time shortened it, not the error
        return;
      }
      ++statistics_.rejected;
      wish = controller_.reject(error, h);
    }
  }

  /// Computes all stages of a step to t1. Returns the scaled error, infinite if a value is not
  /// finite.
  double try_step(double h, double t1) {
    const detail::Attempt attempt{
        t0_, t1, h, options_.rtol, options_.atol, options_.each_rtol(), options_.each_atol()};
    t1_ = t1;
    const detail::MethodKernels* steps = compiled();
    const double error = steps != nullptr
                             ? steps->attempt(caller(), attempt, memory())
                             : arithmetic(x0_.data(), x1_.data()).attempt(attempt, rate());
    if (watches_stiffness_ && error <= 1.0)
      stiff_.look(h, view(x1_.data()), view(scratch_.data()), view(stage(last - 1)), view(stage(0)),
                  view(stage(last)));
    return error;
  }

  /// The steps that were compiled together with the right-hand side, if there are any.
  const detail::MethodKernels* compiled() const {
    const RightHandSide* function = machine_->inlined().function;
    return function == nullptr ? nullptr : &detail::kernels_of(*function).template of<Method>();
  }
  detail::Caller caller() {
    const Machine::Inlined inlined = machine_->inlined();
    return {&inlined.function->function, inlined.leaf, inlined.at, &machine_->rhs_calls};
  }
  detail::StepMemory memory() { return {x0_.data(), x1_.data(), scratch_.data(), k_.data()}; }

  detail::ExplicitStep<Method, N> arithmetic(const double* from, double* to) {
    return {n_, from, to, scratch_.data(), k_.data()};
  }
  /// The right-hand side. It is inlined into each stage, except when two states form a pair:
  /// inlined code would load the pair as one before the user's two stores are done (a run takes 1.3
  /// times the time; 0.5 times with four states).
  auto rate() {
    if constexpr (W > 0)
      return [this](double t, const double* x, double* xdot) { machine_->derivative(t, x, xdot); };
    else
      return [this](double t, const double* x, double* xdot) __attribute__((always_inline)) {
        machine_->derivative(t, x, xdot);
      };
  }

  void prepare_dense() {
    if constexpr (Method::rows > Method::stages) prepare_stages();
    dense_.set(length_, x0_.data(), x1_.data(), k_.data());
    dense_ready_ = true;
    if constexpr (checks_dense) halves_.used = dense_is_off() && halve();
  }

  /// Computes the stages that only the dense output needs.
  void prepare_stages() {
    if (const detail::MethodKernels* steps = compiled())
      steps->dense(caller(), t0_, length_, memory());
    else
      arithmetic(x0_.data(), x1_.data())
          .template stages<Method::stages, Method::rows>(t0_, length_, rate());
  }

  /// Root mean square of value(i), which is one lane, in tolerances.
  template <class Value>
  double in_tolerances(Value value) const {
    const auto tolerance = [this](Index i, const Lane& size) -> Lane {
      if (options_.rtols.empty()) return options_.atol + options_.rtol * size;
      return detail::load<W>(options_.each_atol() + i) +
             detail::load<W>(options_.each_rtol() + i) * size;
    };
    double sum = 0.0;
    detail::for_lanes<W, N>(size(), [&](Index i) {
      const Lane largest =
          detail::larger(detail::load<W>(x0_.data() + i), detail::load<W>(x1_.data() + i));
      sum += detail::sum_of_squares(Lane(value(i) / tolerance(i, largest)));
    });
    return std::sqrt(sum / static_cast<double>(size()));
  }

  /// Whether the error of the dense output is above the allowed one. It is not if its last term
  /// is small, which costs no call. Otherwise the largest defect decides.
  [[gnu::noinline]] bool dense_is_off()
    requires checks_dense
  {
    constexpr double at = Method::defect_at;
    const auto term = [&](Index i) { return dense_.last_term(i); };
    if (Method::last_term_share * in_tolerances(term) <= thresholds::dense_room) return false;
    dense_.read(x0_.data(), at, scratch_.data());
    double* f = halves_.slope.data();
    machine_->derivative(t0_ + at * length_, scratch_.data(), f);
    const auto defect = [&](Index i) -> Lane {
      return dense_.template slope<at>(i) - length_ * detail::load<W>(f + i);
    };
    return !(Method::defect_share * in_tolerances(defect) <= thresholds::dense_room);
  }

  /// Takes the step again in two halves, for looks inside it. The step itself does not change.
  /// False if a value is not finite.
  bool halve()
    requires checks_dense
  {
    const double h = 0.5 * length_;
    std::copy_n(stage(last), size(), halves_.slope.data());
    take_half(t0_, x0_.data(), h, halves_.middle.data(), halves_.first);
    std::copy_n(stage(last), size(), stage(0));
    take_half(t0_ + h, halves_.middle.data(), h, halves_.shift.data(), halves_.second);
    std::copy_n(halves_.slope.data(), size(), stage(last));
    halves_.shift = x1_ - halves_.shift;
    return halves_.finite();
  }
  [[gnu::noinline]] void take_half(double t, const double* from, double h, double* to,
                                   StepPolynomial<Method, N>& dense) {
    auto step = arithmetic(from, to);
    step.end(t, h, rate());
    machine_->derivative(t + h, to, stage(last));
    step.template stages<Method::stages, Method::rows>(t, h, rate());
    dense.set(h, from, to, k_.data());
  }

  void require_finite_start() {
    // The sum is finite if all of its terms are finite, unless it overflows. If it is not finite,
    // each term is checked.
    double sum = 0.0;
    for (Index i = 0; i < size(); ++i) sum += stage(0)[i];
    if (!std::isfinite(sum) && !view(stage(0)).allFinite())
      throw_not_finite(*machine_, t0_, x0_.data());
  }
  void require_room(double h) {
    if (!has_room(t0_, h, options_)) throw_step_too_small(*machine_, t0_, h, x0_.data(), options_);
  }

  double h_ = 0.0;
  double horizon_ = infinite;
  Eigen::VectorXd x0_, scratch_;
  detail::Columns<N, Method::rows> k_;
  StepPolynomial<Method, N> dense_;
  bool dense_ready_ = false;
  std::conditional_t<checks_dense, Halves<Method, N>, NoHalves> halves_;
  StepController controller_ = controller();
  bool watches_stiffness_ = false;
  StiffnessTest stiff_;
};

}  // namespace saltus
