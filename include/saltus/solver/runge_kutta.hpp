// One-step method of explicit Runge-Kutta type with dense output and location on it. No history: a
// restart after a reset costs one evaluation of the right-hand side.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "saltus/solver/halves.hpp"
#include "saltus/solver/one_step.hpp"
#include "saltus/solver/step_size.hpp"
#include "saltus/solver/step_solver.hpp"
#include "saltus/solver/stiffness.hpp"

namespace saltus {

/// N: how many states there are, or 0 for a number that is known at run time only.
template <Tableau Method, int N = 0>
class RungeKutta final : public StepSolver<RungeKutta<Method, N>, OneStepSolver> {
 public:
  RungeKutta(Machine& machine, Watch& watch, const SolverOptions& options)
      : Base(machine, watch, options),
        x0_(n_),
        scratch_(n_),
        k_(n_),
        dense_(n_),
        halves_(n_),
        stiff_(Method::stability, static_cast<double>(last), options) {}

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

  void watch_stiffness() override { watches_stiffness_ = true; }
  bool looks_stiff() const override { return stiff_.detected(); }
  double stability() const override { return Method::stability; }

 private:
  using Base = StepSolver<RungeKutta<Method, N>, OneStepSolver>;
  using Lane = detail::Lane<N>;
  friend Base;
  using Base::machine_, Base::options_, Base::n_, Base::t0_, Base::t1_, Base::length_, Base::x1_,
      Base::statistics_;
  static constexpr std::size_t last = Method::stages - 1;
  static constexpr std::size_t estimates = Method::e.size();
  static constexpr bool checks_dense = ChecksDense<Method>;
  /// Whether the error estimate reads f(t1, x1); if not, a rejected step is spared that call.
  static constexpr bool estimate_reads_end =
      std::ranges::any_of(Method::e, [](const auto& row) { return row[last] != 0.0; });
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  static StepController controller() {
    return {Method::error_order, Method::beta, Method::shortest, Method::longest};
  }
  Index size() const {
    if constexpr (N == 0)
      return n_;
    else
      return N;
  }
  VectorView view(const double* x) const { return {x, size()}; }
  double* stage(std::size_t i) { return k_.data() + static_cast<Index>(i) * size(); }

  void begin(const Start& start) {
    if (start.first || start.handover) h_ = 0.0, controller_ = controller();
    if (start.flow != nullptr)
      std::copy_n(start.flow->data(), size(), stage(last));
    else
      machine_->derivative(t1_, x1_.data(), stage(last));
    dense_ready_ = false;
    horizon_ = start.horizon;
    stiff_.forget();
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
    h_ = std::max(h_, options_.min_step);  // a guess is no need
    double wish = std::min({h_, options_.max_step, std::exchange(horizon_, infinite)});
    const double left = t_stop - t0_;
    for (bool rejected = false;; rejected = true) {
      const bool ends = wish >= left;
      // Two equal steps rather than a step and a sliver.
      const double h = ends ? left : 2.0 * wish > left ? 0.5 * left : wish;
      if (!ends) require_room(h);
      const double error = try_step(h, ends ? t_stop : t0_ + h);
      if (error <= 1.0) {
        ++statistics_.steps;
        length_ = h;
        h_ = controller_.accept(error, h, rejected);
        if (!rejected && h < wish)
          h_ = std::max(h_, wish);  // cut by the stop time, not by the error
        return;
      }
      ++statistics_.rejected;
      wish = controller_.reject(error, h);
    }
  }

  /// All stages of a step to t1; returns the scaled error, infinite if anything is not finite.
  double try_step(double h, double t1) {
    run_stages<1, last>(t0_, x0_.data(), h);
    combine<last>(x0_.data(), h, x1_.data());
    t1_ = t1;
    double error = 0.0;
    if constexpr (!estimate_reads_end) {
      error = scaled_error(h);
      if (error > 1.0) return error;
    }
    machine_->derivative(t1, x1_.data(), stage(last));
    if constexpr (estimate_reads_end)
      error = scaled_error(h);
    else if (!view(stage(last)).allFinite())
      return infinite;
    if (watches_stiffness_ && error <= 1.0)  // scratch_: what the last stage but one read
      stiff_.look(h, view(x1_.data()), view(scratch_.data()), view(stage(last - 1)), view(stage(0)),
                  view(stage(last)));
    return error;
  }

  /// Stages First to End - 1.
  template <std::size_t First, std::size_t End>
  [[gnu::always_inline]] void run_stages(double t, const double* x, double h) {
    if constexpr (First < End) {
      run_stage<First>(t, x, h);
      run_stages<First + 1, End>(t, x, h);
    }
  }

  template <std::size_t I>
  [[gnu::always_inline]] void run_stage(double t, const double* x, double h) {
    combine<I>(x, h, scratch_.data());
    machine_->derivative(t + Method::c[I] * h, scratch_.data(), stage(I));
  }

  /// x0 + h sum_j a[I][j] k_j
  template <std::size_t I>
  [[gnu::always_inline]] void combine(const double* x0, double h, double* out) const {
    const double* k = k_.data();
    constexpr auto row = [] { return Method::a[I]; };
    detail::for_lanes<N>(size(), [&](Index i) {
      Lane sum = detail::zero<N>();
      if constexpr (detail::cancels(row()))
        sum = Method::c[I] * detail::load<N>(k + i) +
              detail::dot_of_differences<row, I, N>(k + i, size());
      else
        sum = detail::dot<row, I, N>(k + i, size());
      detail::store<N>(out + i, detail::load<N>(x0 + i) + h * sum);
    });
  }

  /// The method's error from the mean squares of estimate / (atol + rtol max(|x0|, |x1|)).
  double scaled_error(double h) const {
    if (size() == 0) return 0.0;
    const double *k = k_.data(), *x0 = x0_.data(), *x1 = x1_.data();
    const double rtol = options_.rtol, atol = options_.atol;
    std::array<double, estimates> squares{};
    detail::for_lanes<N>(size(), [&](Index i) {
      const Lane largest = detail::larger(detail::load<N>(x0 + i), detail::load<N>(x1 + i));
      add_squares(h, atol + rtol * largest, k + i, squares, std::make_index_sequence<estimates>{});
    });
    for (double& square : squares) square /= static_cast<double>(size());
    const double error = Method::error(squares);
    return std::isfinite(error) ? error : infinite;
  }
  template <std::size_t... M>
  void add_squares(double h, const Lane& tolerance, const double* k,
                   std::array<double, estimates>& squares, std::index_sequence<M...>) const {
    ((squares[M] += detail::sum_of_squares(Lane(
          h * detail::dot<[] { return Method::e[M]; }, Method::stages, N>(k, size()) / tolerance))),
     ...);
  }

  void prepare_dense() {
    run_stages<Method::stages, Method::rows>(t0_, x0_.data(), length_);
    dense_.set(length_, x0_.data(), x1_.data(), k_.data());
    dense_ready_ = true;
    if constexpr (checks_dense) halves_.used = dense_is_off() && halve();
  }

  /// Root mean square of value(i), a lane each, in tolerances.
  template <class Value>
  double in_tolerances(Value value) const {
    double sum = 0.0;
    detail::for_lanes<N>(size(), [&](Index i) {
      const Lane largest =
          detail::larger(detail::load<N>(x0_.data() + i), detail::load<N>(x1_.data() + i));
      sum += detail::sum_of_squares(Lane(value(i) / (options_.atol + options_.rtol * largest)));
    });
    return std::sqrt(sum / static_cast<double>(size()));
  }

  /// Whether the dense output misses by more than `room` tolerances: seen without a call where its
  /// last term is small, else by its defect where that is largest.
  [[gnu::noinline]] bool dense_is_off()
    requires checks_dense
  {
    constexpr double room = 4.0;  // of the ten that an event may be off
    constexpr double at = Method::defect_at;
    const auto term = [&](Index i) { return dense_.last_term(i); };
    if (Method::last_term_share * in_tolerances(term) <= room) return false;
    dense_.read(x0_.data(), at, scratch_.data());
    double* f = halves_.slope.data();
    machine_->derivative(t0_ + at * length_, scratch_.data(), f);
    const auto defect = [&](Index i) -> Lane {
      return dense_.template slope<at>(i) - length_ * detail::load<N>(f + i);
    };
    return !(Method::defect_share * in_tolerances(defect) <= room);
  }

  /// Takes the step again in two halves, to be looked into; the step itself stays what it was.
  /// False if something is not finite there.
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
    run_stages<1, last>(t, from, h);
    combine<last>(from, h, to);
    machine_->derivative(t + h, to, stage(last));
    run_stages<Method::stages, Method::rows>(t, from, h);
    dense.set(h, from, to, k_.data());
  }

  void require_finite_start() {
    // A sum is finite if all of its terms are, short of overflow: then the terms are asked one by
    // one.
    double sum = 0.0;
    for (Index i = 0; i < size(); ++i) sum += stage(0)[i];
    if (!std::isfinite(sum) && !view(stage(0)).allFinite())
      throw_not_finite(*machine_, t0_, x0_.data());
  }
  void require_room(double h) {
    const double smallest = 16.0 * std::numeric_limits<double>::epsilon() * std::abs(t0_);
    if (!(h > smallest && h >= options_.min_step))
      throw_step_too_small(*machine_, t0_, h, x0_.data(), options_);
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
