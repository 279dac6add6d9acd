// The arithmetic of one explicit step. The right-hand side is evaluated by the stepper through the
// machine, or by code compiled together with a user's function (`inlined.hpp`).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/solver/detail/tableau.hpp"

namespace saltus::detail {

/// An attempt to go from t0 to t1 = t0 + h.
struct Attempt {
  double t0, t1, h;  // [s]
  double rtol, atol;
  const double *rtols = nullptr, *atols = nullptr;  // of each state; null: one for all
};

/// A step on the memory of a stepper. It reads x0 and k[0] = f(t0, x0), and computes x1 and all
/// other k. Column i of k begins at k[i n]. N is the number of states, or 0 if n is known at run
/// time only. `rate(t, x, xdot)` is the right-hand side.
template <Tableau Method, int N, int W = called_width<N>>
class ExplicitStep {
 public:
  static constexpr std::size_t last = Method::stages - 1;
  /// Whether the error estimate reads f(t1, x1). If not, a rejected step does not need that call.
  static constexpr bool estimate_reads_end =
      std::ranges::any_of(Method::e, [](const auto& row) { return row[last] != 0.0; });

  ExplicitStep(Index n, const double* x0, double* x1, double* scratch, double* k)
      : n_(n), x0_(x0), x1_(x1), scratch_(scratch), k_(k) {}

  /// Tries the step. Returns the scaled error, infinite if a value is not finite. If it is at most
  /// 1, all of k is computed, and scratch has the argument of the last stage but one.
  template <class Rate>
  double attempt(const Attempt& a, const Rate& rate) {
    end(a.t0, a.h, rate);
    if constexpr (estimate_reads_end) {
      rate(a.t1, x1_, column(last));
      return error(a);
    } else {
      const double found = error(a);
      if (found > 1.0) return found;
      rate(a.t1, x1_, column(last));
      return VectorView(column(last), size()).allFinite() ? found : infinite;
    }
  }

  /// Computes x1 and the stages it needs.
  template <class Rate>
  [[gnu::always_inline]] void end(double t0, double h, const Rate& rate) {
    stages<1, last>(t0, h, rate);
    combine<last>(h, x1_);
  }

  /// Computes stages First to End - 1.
  template <std::size_t First, std::size_t End, class Rate>
  [[gnu::always_inline]] void stages(double t0, double h, const Rate& rate) {
    if constexpr (First < End) {
      stage<First>(t0, h, rate);
      stages<First + 1, End>(t0, h, rate);
    }
  }

 private:
  static constexpr std::size_t estimates = Method::e.size();
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  Index size() const { return count<N>(n_); }
  double* column(std::size_t i) { return k_ + static_cast<Index>(i) * size(); }

  template <std::size_t I, class Rate>
  [[gnu::always_inline]] void stage(double t0, double h, const Rate& rate) {
    combine<I>(h, scratch_);
    rate(t0 + Method::c[I] * h, scratch_, column(I));
  }

  /// x0 + h sum_j a[I][j] k_j
  template <std::size_t I>
  [[gnu::always_inline]] void combine(double h, double* out) const {
    constexpr auto row = [] { return Method::a[I]; };
    for_lanes<W, N>(size(), [&](Index i) {
      Lane<W> sum = zero<W>();
      if constexpr (cancels(row()))
        sum = Method::c[I] * load<W>(k_ + i) + dot_of_differences<row, I, W>(k_ + i, size());
      else
        sum = dot<row, I, W>(k_ + i, size());
      store<W>(out + i, load<W>(x0_ + i) + h * sum);
    });
  }

  /// The method's error from the mean squares of estimate / (atol + rtol max(|x0|, |x1|)).
  double error(const Attempt& a) const {
    if (a.rtols != nullptr) {
      return error_in(a.h, [&a](Index i, const Lane<W>& largest) -> Lane<W> {
        return load<W>(a.atols + i) + load<W>(a.rtols + i) * largest;
      });
    }
    return error_in(
        a.h, [&a](Index, const Lane<W>& largest) -> Lane<W> { return a.atol + a.rtol * largest; });
  }
  template <class Tolerance>
  [[gnu::always_inline]] double error_in(double h, const Tolerance& tolerance) const {
    if (size() == 0) return 0.0;
    std::array<double, estimates> squares{};
    for_lanes<W, N>(size(), [&](Index i) {
      const Lane<W> x1 = load<W>(x1_ + i), largest = larger(load<W>(x0_ + i), x1);
      // A state that is infinite has an infinite tolerance: x1 - x1 makes its error NaN.
      add_squares(h, tolerance(i, largest) + (x1 - x1), k_ + i, squares,
                  std::make_index_sequence<estimates>{});
    });
    for (double& square : squares) square /= static_cast<double>(size());
    double found = Method::error(squares);
    if constexpr (requires { Method::is_doubtful(found, squares); })
      if (Method::is_doubtful(found, squares))
        found = Method::corrected(found, squares, moved(h, tolerance));
    return std::isfinite(found) ? found : infinite;
  }
  /// How far the states move in the step, by its end or by the derivative at its begin: the root
  /// mean square, in tolerances.
  template <class Tolerance>
  double moved(double h, const Tolerance& tolerance) const {
    double square = 0.0;
    for_lanes<W, N>(size(), [&](Index i) {
      const Lane<W> x0 = load<W>(x0_ + i), x1 = load<W>(x1_ + i);
      const Lane<W> way = larger(Lane<W>(x1 - x0), Lane<W>(h * load<W>(k_ + i)));
      square += sum_of_squares(Lane<W>(way / tolerance(i, larger(x0, x1))));
    });
    return std::sqrt(square / static_cast<double>(size()));
  }
  template <std::size_t... M>
  void add_squares(double h, const Lane<W>& tolerance, const double* k,
                   std::array<double, estimates>& squares, std::index_sequence<M...>) const {
    ((squares[M] += sum_of_squares(
          Lane<W>(h * dot<[] { return Method::e[M]; }, Method::stages, W>(k, size()) / tolerance))),
     ...);
  }

  Index n_;
  const double* x0_;
  double *x1_, *scratch_, *k_;
};

}  // namespace saltus::detail
