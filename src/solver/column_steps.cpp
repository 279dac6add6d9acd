// ColumnSteps of dopri5 and dop853.
#include "saltus/solver/detail/column_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "saltus/solver/detail/dop853.hpp"
#include "saltus/solver/detail/dopri5.hpp"
#include "saltus/solver/detail/step_polynomial.hpp"

namespace saltus {

namespace {

template <Tableau Method>
class ColumnStepsOf final : public ColumnSteps {
 public:
  ColumnStepsOf(Index n, Index m)
      : n_(n), size_(n * m), x_(as_size(n)), s_(as_size(size_)), dense_(size_) {
    k_.assign(Method::rows * as_size(size_), 0.0);
  }

  void step(const StepStages& step, ColumnRate& rate, const double* s0, double* s1,
            bool continues) override {
    if (continues)
      std::copy_n(stage(last), size_, stage(0));
    else
      rate.go_to(step.t0, step.x0), rate.apply(s0, stage(0));
    stages<1, last>(step, rate, s0);
    combine<last>(step.h, s0, k_.data(), size_, s1);
    rate.go_to(step.t1, step.x1), rate.apply(s1, stage(last));
  }

  bool within(double most, const StepStages& step, const Tolerances& tolerances, const double* s0,
              const double* s1) const override {
    for (Index i = 0; i < size_; ++i) {
      const double size = std::max(std::abs(s0[i]), std::abs(s1[i]));
      // An infinite entry has an infinite tolerance: s1 - s1 makes its error NaN.
      const double allowed = most * (tolerances.atol[i] + tolerances.rtol * size) + (s1[i] - s1[i]);
      if (!(estimate(step.h, i) <= allowed) && std::isfinite(s0[i])) return false;
    }
    return true;
  }

  void prepare_dense(const StepStages& step, ColumnRate& rate, const double* s0,
                     const double* s1) override {
    stages<Method::stages, Method::rows>(step, rate, s0);
    dense_.set(step.h, s0, s1, k_.data());
  }
  void read(double part, const double* s0, double* s) const override { dense_.read(s0, part, s); }
  int degree() const override { return static_cast<int>(StepPolynomial<Method, 0>::terms); }

 private:
  static constexpr std::size_t last = Method::stages - 1;
  static constexpr std::size_t estimates = Method::e.size();

  static std::size_t as_size(Index n) { return static_cast<std::size_t>(n); }
  double* stage(std::size_t i) { return k_.data() + static_cast<Index>(i) * size_; }

  template <std::size_t First, std::size_t End>
  void stages(const StepStages& step, ColumnRate& rate, const double* s0) {
    if constexpr (First < End) {
      combine<First>(step.h, step.x0, step.k, n_, x_.data());
      combine<First>(step.h, s0, k_.data(), size_, s_.data());
      rate.go_to(step.t0 + Method::c[First] * step.h, x_.data());
      rate.apply(s_.data(), stage(First));
      stages<First + 1, End>(step, rate, s0);
    }
  }

  /// begin + h sum_j a[I][j] k_j, in pairs: the arithmetic of ExplicitStep.
  template <std::size_t I>
  static void combine(double h, const double* begin, const double* k, Index size, double* out) {
    Index i = 0;
    for (; i + 1 < size; i += 2) combine_lane<I, 2>(h, begin + i, k + i, size, out + i);
    if (i < size) combine_lane<I, 0>(h, begin + i, k + i, size, out + i);
  }
  template <std::size_t I, int W>
  static void combine_lane(double h, const double* begin, const double* k, Index size,
                           double* out) {
    constexpr auto row = [] { return Method::a[I]; };
    detail::Lane<W> sum = detail::zero<W>();
    if constexpr (detail::cancels(row()))
      sum = Method::c[I] * detail::load<W>(k) + detail::dot_of_differences<row, I, W>(k, size);
    else
      sum = detail::dot<row, I, W>(k, size);
    detail::store<W>(out, detail::load<W>(begin) + h * sum);
  }

  /// The error of entry i: that of the method, for this entry alone.
  double estimate(double h, Index i) const {
    return [&]<std::size_t... M>(std::index_sequence<M...>) {
      const std::array<double, estimates> of{
          h * detail::dot<[] { return Method::e[M]; }, Method::stages, 0>(k_.data() + i, size_)...};
      std::array<double, estimates> squares{};
      for (std::size_t m = 0; m < estimates; ++m) squares[m] = of[m] * of[m];
      return Method::error(squares);
    }(std::make_index_sequence<estimates>{});
  }

  Index n_, size_;
  std::vector<double> x_, s_, k_;  // of a stage; of all stages
  StepPolynomial<Method, 0> dense_;
};

}  // namespace

template <class Method>
std::unique_ptr<ColumnSteps> make_column_steps(Index n, Index m) {
  return std::make_unique<ColumnStepsOf<Method>>(n, m);
}

template std::unique_ptr<ColumnSteps> make_column_steps<Dopri5>(Index n, Index m);
template std::unique_ptr<ColumnSteps> make_column_steps<Dop853>(Index n, Index m);

}  // namespace saltus
