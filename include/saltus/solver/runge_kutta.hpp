// One-step method of explicit Runge-Kutta type with dense output and location on it. No history: a
// restart after a reset costs one evaluation of the right-hand side.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "saltus/solver/step_size.hpp"
#include "saltus/solver/step_solver.hpp"
#include "saltus/solver/tableau.hpp"

namespace saltus {

template <Tableau Method>
class RungeKutta final : public StepSolver<RungeKutta<Method>> {
 public:
  RungeKutta(Machine& machine, Watch& watch, const SolverOptions& options)
      : Base(machine, watch, options),
        x0_(n_),
        scratch_(n_),
        k_(Eigen::MatrixXd::Zero(n_, static_cast<Index>(Method::stages))),
        dense_(n_, 4) {}

  void inside_step(double u, double* x) {
    if (!dense_ready_) prepare_dense();
    const double s = u / length_, r = 1.0 - s;
    const double *x0 = x0_.data(), *c = dense_.data();
    for (Index i = 0, n = n_; i < n; ++i)
      x[i] = x0[i] + s * (c[i] + r * (c[n + i] + s * (c[2 * n + i] + r * c[3 * n + i])));
  }

  std::string method() const override { return Method::name; }

  /// Whether the last steps were bounded by stability rather than by accuracy.
  bool looks_stiff() const noexcept { return stiff_.detected(); }

 private:
  using Base = StepSolver<RungeKutta<Method>>;
  friend Base;
  using Base::machine_, Base::options_, Base::n_, Base::t0_, Base::t1_, Base::length_, Base::x1_,
      Base::statistics_;
  static constexpr std::size_t last = Method::stages - 1;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  double* stage(std::size_t i) { return k_.data() + static_cast<Index>(i) * n_; }

  void begin(const Start& start) {
    if (start.first) h_ = 0.0, controller_ = StepController(Method::error_order);
    machine_->derivative(t1_, x1_.data(), stage(last));
    dense_ready_ = false;
    horizon_ = start.horizon;
    stiff_.forget();
  }

  /// Tries steps until one is accepted.
  void step(double t_stop) {
    x0_.swap(x1_);
    std::copy_n(stage(last), n_, stage(0));
    dense_ready_ = false;
    require_finite_start();
    if (h_ == 0.0)
      h_ = first_step(*machine_, t0_, x0_, stage(0), scratch_, stage(1), options_,
                      Method::error_order, t_stop);
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
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (run_stage<I + 1>(h), ...);
    }(std::make_index_sequence<last - 1>{});
    combine<last>(h, x1_.data());
    t1_ = t1;
    machine_->derivative(t1, x1_.data(), stage(last));
    const double error = scaled_error(h);
    stiff_.look(*this, h, error);
    return error;
  }

  template <std::size_t I>
  void run_stage(double h) {
    combine<I>(h, scratch_.data());
    machine_->derivative(t0_ + Method::c[I] * h, scratch_.data(), stage(I));
  }

  /// x0 + h sum_j a[I][j] k_j
  template <std::size_t I>
  void combine(double h, double* out) const {
    const double *k = k_.data(), *x0 = x0_.data();
    for (Index i = 0, n = n_; i < n; ++i) {
      out[i] =
          x0[i] + h * dot<[] { return Method::a[I]; }>(k + i, n, std::make_index_sequence<I>{});
    }
  }
  /// sum_j row[j] k_j, without the terms that are zero.
  template <auto Row, std::size_t... J>
  static double dot(const double* k, Index n, std::index_sequence<J...>) {
    double sum = 0.0;
    ((Row()[J] != 0.0 ? void(sum += Row()[J] * k[static_cast<Index>(J) * n]) : void()), ...);
    return sum;
  }

  /// Root mean square of error / (atol + rtol max(|x0|, |x1|)).
  double scaled_error(double h) const {
    const double *k = k_.data(), *x0 = x0_.data(), *x1 = x1_.data();
    const double rtol = options_.rtol, atol = options_.atol;
    double sum = 0.0;
    for (Index i = 0, n = n_; i < n; ++i) {
      const double scale = atol + rtol * std::max(std::abs(x0[i]), std::abs(x1[i]));
      const double e =
          h * dot<[] { return Method::e; }>(k + i, n, std::make_index_sequence<Method::stages>{}) /
          scale;
      sum += e * e;
    }
    const double error = n_ > 0 ? std::sqrt(sum / static_cast<double>(n_)) : 0.0;
    return std::isfinite(error) ? error : infinite;
  }

  void prepare_dense() {
    const double *k = k_.data(), *x0 = x0_.data(), *x1 = x1_.data();
    double* c = dense_.data();
    const double h = length_;
    for (Index i = 0, n = n_; i < n; ++i) {
      const double rise = x1[i] - x0[i], bend = h * k[i] - rise;
      c[i] = rise;
      c[n + i] = bend;
      c[2 * n + i] = rise - h * k[static_cast<Index>(last) * n + i] - bend;
      c[3 * n + i] =
          h * dot<[] { return Method::d; }>(k + i, n, std::make_index_sequence<Method::stages>{});
    }
    dense_ready_ = true;
  }

  void require_finite_start() {
    // A sum is finite if all of its terms are, short of overflow: then the terms are asked one by
    // one.
    double sum = 0.0;
    for (Index i = 0; i < n_; ++i) sum += stage(0)[i];
    if (!std::isfinite(sum) && !VectorView(stage(0), n_).allFinite())
      throw_not_finite(*machine_, t0_, x0_.data());
  }
  void require_room(double h) {
    const double smallest =
        std::max(options_.min_step, 16.0 * std::numeric_limits<double>::epsilon() * std::abs(t0_));
    if (!(h > smallest)) throw_step_too_small(*machine_, t0_, h, x0_.data(), options_);
  }

  friend class StiffnessTest;

  double h_ = 0.0;
  double horizon_ = infinite;
  Eigen::VectorXd x0_, scratch_;
  Eigen::MatrixXd k_, dense_;
  bool dense_ready_ = false;
  StepController controller_{Method::error_order};
  StiffnessTest stiff_;
};

}  // namespace saltus
